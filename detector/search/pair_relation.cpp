#include "detector/search/pair_relation.h"

#include <algorithm>

#include "detector/geometry/near_regions.h"

namespace assay::detector {
namespace {

template <class Pair>
void sort_once(std::vector<Pair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

template <class Pair>
bool lists(const std::vector<Pair>& sorted, const Pair& pair) {
  return std::binary_search(sorted.begin(), sorted.end(), pair);
}

TwoEdges in_order(TwoEdges pair) {
  std::sort(pair.a.begin(), pair.a.end());
  std::sort(pair.b.begin(), pair.b.end());
  if (pair.b < pair.a) std::swap(pair.a, pair.b);
  return pair;
}

// Returns the vertices that a path of at most `steps` edges joins to one of these, ascending.
std::vector<std::int32_t> reached(const Topology& mesh, std::span<const std::int32_t> from,
                                  std::int32_t steps) {
  std::vector<std::int32_t> all(from.begin(), from.end()), last = all, next;
  sort_once(all);
  for (; steps > 0 && !last.empty(); --steps) {
    next.clear();
    for (const auto v : last) {
      for (const auto t : mesh.vertex_triangles.row(v)) {
        for (const auto u : mesh.triangles[at(t)]) {
          if (!std::binary_search(all.begin(), all.end(), u)) next.push_back(u);
        }
      }
    }
    sort_once(next);
    all.insert(all.end(), next.begin(), next.end());
    std::sort(all.begin(), all.end());
    std::swap(last, next);
  }
  return all;
}

bool have_common(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b) {
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (*i == *j) return true;
    ++(*i < *j ? i : j);
  }
  return false;
}

bool share_vertex(std::span<const std::int32_t> a, std::span<const std::int32_t> b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

}  // namespace

PairRelation::PairRelation(const CountedPairs* counted, const Topology& mesh) {
  if (!counted || counted->count_all()) return;
  counted_ = std::make_unique<const CountedPairs>(*counted);
  for (auto pair : counted_->apart) {
    std::sort(pair.begin(), pair.end());
    apart_.push_back(pair);
  }
  sort_once(apart_);
  for (const auto& [a, b] : counted_->triangle_pairs)
    triangle_pairs_.push_back({std::min(a, b), std::max(a, b)});
  sort_once(triangle_pairs_);
  vertex_faces_ = counted_->vertex_faces;
  sort_once(vertex_faces_);
  for (const auto& pair : counted_->edge_pairs) edge_pairs_.push_back(in_order(pair));
  sort_once(edge_pairs_);
  sorts_contacts_ = counted_->rings > 0 || checks_distance() || !triangle_pairs_.empty() ||
                    !vertex_faces_.empty() || !edge_pairs_.empty();
  if (apart_.empty()) return;
  std::uint64_t digest = 0xcbf29ce484222325u;
  for (const auto& component : mesh.components) {
    const auto c = static_cast<std::int32_t>(body_of_component_.size());
    const auto& body = counted_->body;
    body_of_component_.push_back(body.empty() ? 0 : body[at(component.vertices.front())]);
    if (components_meet(c, c)) continue;
    leaves_out_components_ = true;
    digest = (digest ^ static_cast<std::uint32_t>(c)) * 0x100000001b3u;
  }
  if (leaves_out_components_) digest_of_left_out_ = digest;
}

bool PairRelation::bodies_meet(std::int32_t b, std::int32_t c) const {
  return !lists(apart_, {std::min(b, c), std::max(b, c)});
}

// Returns whether two features may count, as far as bodies and rings tell.
bool PairRelation::may_count(const Topology& mesh, Vertices a, Vertices b) const {
  const auto& body = counted_->body;
  const auto body_of = [&](std::int32_t v) { return body.empty() ? 0 : body[at(v)]; };
  if (!apart_.empty() && !bodies_meet(body_of(a[0]), body_of(b[0]))) return false;
  return counted_->rings == 0 || !are_joined(mesh, a, b);
}

// Returns whether a path of fewer than `rings` edges joins a vertex of `a` to a vertex of `b`. No
// path joins two components. The path is looked for from both ends, because the number of vertices
// reached grows with the square of the steps.
bool PairRelation::are_joined(const Topology& mesh, Vertices a, Vertices b) const {
  const std::int32_t steps = counted_->rings - 1;
  if (steps == 0) return share_vertex(a, b);
  const auto component_of = [&](std::int32_t v) {
    return mesh.component_of_triangle[at(*mesh.vertex_triangles.row(v).begin())];
  };
  if (component_of(a[0]) != component_of(b[0])) return false;
  return have_common(reached(mesh, a, steps / 2), reached(mesh, b, steps - steps / 2));
}

template <std::size_t n>
std::array<Point, n> PairRelation::at_rest(const std::array<std::int32_t, n>& vertices) const {
  std::array<Point, n> points;
  for (std::size_t i = 0; i < n; ++i) points[i] = counted_->rest[at(vertices[i])];
  return points;
}

bool PairRelation::counts(const Topology& mesh, const TrianglePair& pair) const {
  if (count_all()) return true;
  if (is_of_features()) return some_feature_pair_counts(mesh, pair.a, pair.b);
  const auto &a = mesh.triangles[at(pair.a)], &b = mesh.triangles[at(pair.b)];
  if (lists(triangle_pairs_, pair) || !may_count(mesh, a, b)) return false;
  return !checks_distance() ||
         !(share_vertex(a, b) ||
           triangles_are_nearer(at_rest(a), at_rest(b), counted_->rest_distance));
}

bool PairRelation::counts_vertex_face(const Topology& mesh, std::int32_t vertex,
                                      std::int32_t face) const {
  const auto& corners = mesh.triangles[at(face)];
  if (lists(vertex_faces_, {vertex, face}) || !may_count(mesh, {&vertex, 1}, corners)) return false;
  return !checks_distance() || !vertex_is_nearer_to_face(counted_->rest[at(vertex)],
                                                         at_rest(corners), counted_->rest_distance);
}

bool PairRelation::counts_edges(const Topology& mesh, std::int32_t e, std::int32_t f) const {
  const auto &a = mesh.edges[at(e)], &b = mesh.edges[at(f)];
  if (lists(edge_pairs_, in_order({a, b})) || !may_count(mesh, a, b)) return false;
  return !checks_distance() || !edges_are_nearer(at_rest(a), at_rest(b), counted_->rest_distance);
}

bool PairRelation::some_feature_pair_counts(const Topology& mesh, std::int32_t a,
                                            std::int32_t b) const {
  const auto some_vertex_on = [&](std::int32_t of, std::int32_t face) {
    const auto &vertices = mesh.triangles[at(of)], &corners = mesh.triangles[at(face)];
    return std::any_of(vertices.begin(), vertices.end(), [&](std::int32_t v) {
      return !share_vertex({&v, 1}, corners) && counts_vertex_face(mesh, v, face);
    });
  };
  if (some_vertex_on(a, b) || some_vertex_on(b, a)) return true;
  for (const auto e : mesh.triangle_edges[at(a)]) {
    for (const auto f : mesh.triangle_edges[at(b)]) {
      if (!share_vertex(mesh.edges[at(e)], mesh.edges[at(f)]) && counts_edges(mesh, e, f))
        return true;
    }
  }
  return false;
}

}  // namespace assay::detector
