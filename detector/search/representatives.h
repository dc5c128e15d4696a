// Which triangle represents a feature, so that each feature pair is tested at one candidate pair
// only.
//
// Every vertex and every edge is represented by ONE of its triangles, and a candidate pair (A, B)
// stands only for the pairs of features that A and B represent [Curtis, Tamstorf, Manocha: fast
// collision detection for deformable models using representative-triangles, 2008]. These are on
// average 3 to 4 of 15 feature pairs, and none is found twice. None is lost: if the boxes of two
// features meet, so do those of their representatives, and this pair is found too if the pair rule
// asks for it.
//
// The rule asks by the types of triangles, so a feature between triangles of several types has a
// representative for each of these types. If the rule asks for some pair of triangles that hold
// the two features, it asks for the representatives of the same types too. So a feature pair may
// come up at several pairs of representatives; it is taken at the first pair of types that is
// asked for (feature_pairs.h). Representatives change with types. They are therefore kept from
// step to step and brought up to date around the triangles that changed.
//
// Example: triangles 0 (V+) and 1 (V0) share the edge e, and triangle 5 (V-) has the edge f. Both 0
// and 1 represent e, each for its own type, and 5 represents f. K asks for (V+,V-) and for (V0,V-),
// so the edges come up twice, at (0,5) and at (1,5). They are tested at (0,5) alone, because
// positive comes before zero in the order of types.
//
// Memory: 5 bytes a triangle.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/topology.h"
#include "detector/search/pair_rule.h"

namespace assay::detector {

// The features that a triangle represents: bit i stands for its corner i, bit 3 + i for its edge
// opposite to corner i.
using RepresentedFeatures = std::uint8_t;
constexpr bool represents_corner(RepresentedFeatures features, std::size_t i) {
  return (features >> i & 1) != 0;
}
constexpr bool represents_edge(RepresentedFeatures features, std::size_t i) {
  return (features >> (3 + i) & 1) != 0;
}

class Representatives {
 public:
  // With all triangles in V+. If `pace` was stopped, they must not be used.
  explicit Representatives(const Topology& mesh, PacedStop* pace = nullptr);

  // Chooses anew for the features of the changed triangles, by the present types of all triangles.
  // Allocates nothing. False if `pace` was stopped; the object must then not be used.
  bool update(const Topology& mesh, const std::vector<TriangleType>& types,
              std::span<const std::int32_t> changed, PacedStop* pace = nullptr);

  RepresentedFeatures of(std::int32_t triangle) const { return features_[at(triangle)]; }
  // The types of all triangles that hold the feature.
  TypeSet types_of_vertex(std::int32_t vertex) const { return vertex_types_[at(vertex)]; }
  TypeSet types_of_edge(std::int32_t edge) const { return edge_types_[at(edge)]; }

 private:
  bool choose_all(const Topology& mesh, const std::vector<TriangleType>& types, PacedStop* pace);
  bool choose_between_types(const Topology& mesh, const std::vector<TriangleType>& types,
                            PacedStop* pace);
  // Makes the lowest triangle of each type in `holders` represent the feature numbered `index`,
  // and returns the types. lists: the corners or the edges of each triangle, among which the
  // feature is found. first_bit: 0 for corners, 3 for edges.
  TypeSet choose(const std::vector<std::array<std::int32_t, 3>>& lists,
                 std::span<const std::int32_t> holders, std::int32_t index, int first_bit,
                 const std::vector<TriangleType>& types);

  std::vector<RepresentedFeatures> features_;  // by triangle
  std::vector<TypeSet> vertex_types_, edge_types_;
};

}  // namespace assay::detector
