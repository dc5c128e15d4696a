// The relation of mesh/counted_pairs.h, as a step asks for it.
//
// Across two components a pair that does not count can be left out from the start, because views,
// ghosts and layers are those of each component alone (L10). A triangle has one body, so a
// component has one too, and the search leaves out two components whose bodies do not meet. In the
// same way nothing is looked for within a component whose body does not meet itself.
//
// Within all other components the laws speak of ALL contacts: a contact that does not count still
// turns triangles to the wrong side. So K, the closure and the state know nothing of the relation.
// The contacts that they find are sorted into those that count and those that do not (L19).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

class PairRelation {
 public:
  // Everything counts.
  PairRelation() = default;
  // Keeps a copy. REQUIRES a relation that has passed check_counted_pairs, or null, and the mesh
  // that the functions below are given. Several threads may ask at the same time.
  PairRelation(const CountedPairs* counted, const Topology& mesh);

  bool count_all() const { return counted_ == nullptr; }
  bool is_of_features() const { return counted_ && counted_->level == CountedLevel::features; }
  // Returns whether pairs that do not count may be among those that a search finds.
  bool sorts_contacts() const { return sorts_contacts_; }

  // Returns whether the bodies of c and d let pairs of these components count; c may be d. 20 ns.
  bool components_meet(std::int32_t c, std::int32_t d) const {
    return apart_.empty() || bodies_meet(body_of_component_[at(c)], body_of_component_[at(d)]);
  }
  // Returns whether there is a component in which nothing is looked for.
  bool leaves_out_components() const { return leaves_out_components_; }
  // Returns 0 if no component is left out, else a hash of the set of components that are left out.
  std::uint64_t digest_of_left_out() const { return digest_of_left_out_; }

  // Returns whether a pair of triangles counts; in a relation of features, whether some feature
  // pair of the two counts. About 50 ns; 10 to 200 us if places at rest have to be compared. For
  // two triangles of one component, rings cost a walk over half as many rings from each: 0.3 ms for
  // 30 rings.
  bool counts(const Topology& mesh, const TrianglePair& pair) const;
  // REQUIRES a relation of features. Edges by their numbers in the mesh.
  bool counts_vertex_face(const Topology& mesh, std::int32_t vertex, std::int32_t face) const;
  bool counts_edges(const Topology& mesh, std::int32_t e, std::int32_t f) const;

 private:
  using Vertices = std::span<const std::int32_t>;
  bool bodies_meet(std::int32_t b, std::int32_t c) const;
  bool may_count(const Topology& mesh, Vertices a, Vertices b) const;
  bool are_joined(const Topology& mesh, Vertices a, Vertices b) const;
  bool some_feature_pair_counts(const Topology& mesh, std::int32_t a, std::int32_t b) const;
  template <std::size_t n>
  std::array<Point, n> at_rest(const std::array<std::int32_t, n>& vertices) const;
  bool checks_distance() const { return counted_->rest_distance > 0; }

  std::unique_ptr<const CountedPairs> counted_;  // null: everything counts
  std::vector<std::int32_t> body_of_component_;
  // Ascending, each pair once, with its lower body first.
  std::vector<std::array<std::int32_t, 2>> apart_;
  std::vector<TrianglePair> triangle_pairs_;
  std::vector<VertexAndFace> vertex_faces_;
  std::vector<TwoEdges> edge_pairs_;
  bool sorts_contacts_ = false, leaves_out_components_ = false;
  std::uint64_t digest_of_left_out_ = 0;
};

}  // namespace assay::detector
