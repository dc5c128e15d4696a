#include "oracle/mesh/pair_relation.h"

#include <algorithm>

#include "oracle/mesh/feature_distance.h"

namespace assay::oracle {

namespace {

Edge sorted(const Edge& e) { return {std::min(e[0], e[1]), std::max(e[0], e[1])}; }

std::array<Edge, 3> edges_of(const Face& f) {
  return {sorted({f[0], f[1]}), sorted({f[1], f[2]}), sorted({f[2], f[0]})};
}

}  // namespace

PairRelation::PairRelation(const detector::CountedPairs& counted, const MeshFeatures& features)
    : counted_(counted), features_(features) {
  for (const auto& [b, c] : counted.apart) {
    apart_.emplace(b, c);
    apart_.emplace(c, b);
  }
  for (const auto& [a, b] : counted.triangle_pairs) faces_.emplace(std::min(a, b), std::max(a, b));
  for (const auto& [v, f] : counted.vertex_faces) vertex_faces_.emplace(v, f);
  for (const auto& [a, b] : counted.edge_pairs) {
    edges_.emplace(sorted(a), sorted(b));
    edges_.emplace(sorted(b), sorted(a));
  }
  if (counted.rings < 2 || features.vertices.empty()) return;
  neighbours_.resize(static_cast<std::size_t>(features.vertices.back()) + 1);
  for (const auto& [u, v] : features.edges) {
    neighbours_[u].push_back(v);
    neighbours_[v].push_back(u);
  }
}

bool PairRelation::bodies_meet(std::int32_t u, std::int32_t v) const {
  if (apart_.empty()) return true;
  const auto& body = counted_.body;
  return body.empty() ? !apart_.count({0, 0}) : !apart_.count({body[u], body[v]});
}

// Breadth first from all vertices of a, ring by ring.
bool PairRelation::are_joined(std::span<const std::int32_t> a,
                              std::span<const std::int32_t> b) const {
  if (counted_.rings == 0) return false;
  std::set<std::int32_t> reach(a.begin(), a.end());
  Vertices ring(a.begin(), a.end());
  for (std::int32_t edges = 0; edges < counted_.rings && !ring.empty(); ++edges) {
    for (const std::int32_t v : ring) {
      if (std::find(b.begin(), b.end(), v) != b.end()) return true;
    }
    if (edges + 1 == counted_.rings) return false;
    Vertices next;
    for (const std::int32_t v : ring) {
      for (const std::int32_t u : neighbours_[v]) {
        if (reach.insert(u).second) next.push_back(u);
      }
    }
    ring = std::move(next);
  }
  return false;
}

bool PairRelation::counts_faces(std::int32_t a, std::int32_t b) const {
  return is_of_features() ? some_feature_pair_counts(a, b) : faces_count(a, b);
}

bool PairRelation::faces_count(std::int32_t a, std::int32_t b) const {
  const Face &f = features_.faces[a], &g = features_.faces[b];
  if (!bodies_meet(f[0], g[0]) || faces_.count({std::min(a, b), std::max(a, b)})) return false;
  if (are_joined(f, g)) return false;
  return counted_.rest_distance == 0 ||
         !faces_nearer_than(counted_.rest, f, g, counted_.rest_distance);
}

bool PairRelation::counts_vertex_face(std::int32_t vertex, std::size_t face) const {
  const Face& f = features_.faces[face];
  if (!bodies_meet(vertex, f[0])) return false;
  if (vertex_faces_.count({vertex, static_cast<std::int32_t>(face)})) return false;
  if (are_joined({&vertex, 1}, f)) return false;
  return counted_.rest_distance == 0 ||
         !vertex_nearer_than(counted_.rest, vertex, f, counted_.rest_distance);
}

bool PairRelation::counts_edges(const Edge& a, const Edge& b) const {
  if (!bodies_meet(a[0], b[0]) || edges_.count({sorted(a), sorted(b)})) return false;
  if (are_joined(a, b)) return false;
  return counted_.rest_distance == 0 ||
         !edges_nearer_than(counted_.rest, a, b, counted_.rest_distance);
}

bool PairRelation::some_feature_pair_counts(std::int32_t a, std::int32_t b) const {
  const Face &f = features_.faces[a], &g = features_.faces[b];
  for (int k = 0; k < 3; ++k) {
    if (!holds(g, f[k]) && counts_vertex_face(f[k], static_cast<std::size_t>(b))) return true;
    if (!holds(f, g[k]) && counts_vertex_face(g[k], static_cast<std::size_t>(a))) return true;
  }
  for (const Edge& e : edges_of(f)) {
    for (const Edge& o : edges_of(g)) {
      if (!share_vertex(e, o) && counts_edges(e, o)) return true;
    }
  }
  return false;
}

void keep_counted(const std::optional<PairRelation>& relation,
                  std::vector<detector::PairContact>& pairs) {
  if (!relation || relation->is_of_features()) return;
  std::erase_if(pairs, [&](const auto& c) { return !relation->counts_faces(c.pair.a, c.pair.b); });
}

}  // namespace assay::oracle
