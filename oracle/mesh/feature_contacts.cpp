#include "oracle/mesh/feature_contacts.h"

namespace assay::oracle {

namespace {

using Holders = std::span<const std::int32_t>;  // the triangles that hold a feature

template <class Test>
void judge(const Holders& of_a, const Holders& of_b, const PairVisitor& visitor, int worker,
           const Test& test) {
  auto some_wanted = [&] {
    for (const std::int32_t s : of_a) {
      for (const std::int32_t t : of_b) {
        if (visitor.wanted(s, t)) return true;
      }
    }
    return false;
  };
  if (!some_wanted() || !test()) return;
  for (const std::int32_t s : of_a) {
    for (const std::int32_t t : of_b) {
      if (visitor.wanted(s, t)) visitor.meet(s, t, worker);
    }
  }
}

// Tests vertices and edges of a against faces of b.
void against_faces(const FeatureIndex& a, const FeatureIndex& b, const FeatureTests& tests,
                   const Workers& workers, const PairVisitor& visitor) {
  const MeshFeatures &fa = a.features(), &fb = b.features();
  for_each_vertex_face(a, b, workers, [&](std::size_t i, std::size_t f, int worker) {
    const auto face = static_cast<std::int32_t>(f);
    judge(fa.triangles_of_vertex.of(i), {&face, 1}, visitor, worker,
          [&] { return tests.vertex_face(fa.vertices[i], fb.faces[f]); });
  });
  if (!tests.piercing) return;
  for_each_edge_face(a, b, workers, [&](std::size_t i, std::size_t f, int worker) {
    const auto face = static_cast<std::int32_t>(f);
    judge(fa.triangles_of_edge.of(i), {&face, 1}, visitor, worker,
          [&] { return tests.piercing(fa.edges[i], fb.faces[f]); });
  });
}

}  // namespace

void for_each_contact(const FeatureIndex& a, const FeatureIndex& b, const FeatureTests& tests,
                      const Workers& workers, const PairVisitor& visitor) {
  const MeshFeatures &fa = a.features(), &fb = b.features();
  if (fa.faces.empty() || fb.faces.empty()) return;
  against_faces(a, b, tests, workers, visitor);
  if (&a == &b) {
    for (const auto& [s, t] : same_vertices_pairs(fa.faces)) {
      if (visitor.wanted(s, t)) visitor.meet(s, t, 0);
    }
  } else {
    const PairVisitor swapped = {
        [&](std::int32_t s, std::int32_t t) { return visitor.wanted(t, s); },
        [&](std::int32_t s, std::int32_t t, int worker) { visitor.meet(t, s, worker); }};
    against_faces(b, a, tests, workers, swapped);
  }
  for_each_edge_edge(a, b, workers, [&](std::size_t i, std::size_t j, int worker) {
    judge(fa.triangles_of_edge.of(i), fb.triangles_of_edge.of(j), visitor, worker,
          [&] { return tests.edge_edge(fa.edges[i], fb.edges[j]); });
  });
}

}  // namespace assay::oracle
