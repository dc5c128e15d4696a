// Says which pairs count in the search of a step: CountedPairs (mesh/counted_pairs.h), prepared for
// one mesh.
//
// A pair of two components that does not count can be left out of the search, because each
// component has its own views, ghosts and layers (L10). All triangles of a component belong to one
// body. So the search leaves out all pairs of two components if pairs of their bodies do not count,
// and all pairs within a component if pairs within its body do not count.
//
// Within all other components the laws need ALL contacts, because a contact that does not count
// also turns triangles to the wrong side. So K, the closure and the state ignore this relation, and
// the contacts found are then sorted into those that count and those that do not (L19).
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
  // A relation in which every pair counts.
  PairRelation() = default;
  // Copies `counted`; null: every pair counts. REQUIRES that `counted` has passed
  // check_counted_pairs, and that the functions below are called with the same mesh. Several
  // threads may call them at the same time.
  PairRelation(const CountedPairs* counted, const Topology& mesh);

  bool count_all() const { return counted_ == nullptr; }
  bool is_of_features() const { return counted_ && counted_->level == CountedLevel::features; }
  // Returns whether a search can find pairs that do not count.
  bool sorts_contacts() const { return sorts_contacts_; }

  // Returns whether pairs of the bodies of components c and d count; c may be equal to d. 20 ns.
  bool components_meet(std::int32_t c, std::int32_t d) const {
    return apart_.empty() || bodies_meet(body_of_component_[at(c)], body_of_component_[at(d)]);
  }
  // Returns whether there is a component within which no pair counts because of its body.
  bool leaves_out_components() const { return leaves_out_components_; }
  // Returns a hash of the set of all components within which no pair counts because of their body;
  // 0 if there is no such component.
  std::uint64_t digest_of_left_out() const { return digest_of_left_out_; }

  // Returns whether a pair of triangles counts; in a relation of features, whether some feature
  // pair of the two counts. About 50 ns; 10 to 200 us if places at rest have to be compared. If
  // `rings` is above 0 and both triangles are in one component, half as many rings around each
  // triangle are searched: 0.3 ms for 30 rings.
  bool counts(const Topology& mesh, const TrianglePair& pair) const;
  // Return whether a feature pair counts. REQUIRES a relation of features. `e` and `f` are indices
  // into Topology::edges.
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

  std::unique_ptr<const CountedPairs> counted_;  // null: every pair counts
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
