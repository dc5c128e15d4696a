// Each feature pair at one candidate pair only.
//
// Every vertex and every edge is represented by ONE of its triangles, and a candidate pair (A, B)
// is asked only for the pairs of features that A and B represent [Curtis, Tamstorf, Manocha: fast
// collision detection for deformable models using representative-triangles, 2008]: of 15 feature
// pairs 3 to 4 on average, and none is found twice. The boxes of two triangles meet where those of
// their features do, so the pair of the representatives is found too, if the pair rule asks for it.
//
// The rule asks by the types of triangles, so a feature between triangles of several types has a
// representative for each of these: whatever pair of triangles that hold the two features the rule
// asks for, the representatives of the same types are asked for. A feature pair may then come up at
// several pairs of representatives; it is taken at the first pair of types that is asked for
// (feature_pairs.h). Representatives change with types, so they are kept from step to step and
// brought up to date around the triangles that changed.
//
// Memory: 5 bytes a triangle.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/topology.h"
#include "detector/search/triangle_type.h"

namespace assay::detector {

// What a triangle represents: bit i its corner i, bit 3 + i its edge opposite to corner i.
using RepresentedFeatures = std::uint8_t;
constexpr bool represents_corner(RepresentedFeatures features, std::size_t i) {
  return (features >> i & 1) != 0;
}
constexpr bool represents_edge(RepresentedFeatures features, std::size_t i) {
  return (features >> (3 + i) & 1) != 0;
}

class Representatives {
 public:
  // All triangles V+. Of no use where `pace` was stopped.
  explicit Representatives(const Topology& mesh, PacedStop* pace = nullptr);

  // Brings what lies around the changed triangles up to their types. Allocates nothing. False where
  // `pace` was stopped: then they are those of no types.
  bool update(const Topology& mesh, const std::vector<TriangleType>& types,
              std::span<const std::int32_t> changed, PacedStop* pace = nullptr);

  RepresentedFeatures of(std::int32_t triangle) const { return features_[at(triangle)]; }
  // The types of the triangles that hold a feature.
  TypeSet types_of_vertex(std::int32_t vertex) const { return vertex_types_[at(vertex)]; }
  TypeSet types_of_edge(std::int32_t edge) const { return edge_types_[at(edge)]; }

 private:
  bool choose_all(const Topology& mesh, const std::vector<TriangleType>& types, PacedStop* pace);
  // The lowest triangle of each type in `holders` represents the feature that is `index` in `lists`
  // of these; returns the types. first_bit: 0 for corners, 3 for edges.
  TypeSet choose(const std::vector<std::array<std::int32_t, 3>>& lists,
                 std::span<const std::int32_t> holders, std::int32_t index, int first_bit,
                 const std::vector<TriangleType>& types);

  std::vector<RepresentedFeatures> features_;  // by triangle
  std::vector<TypeSet> vertex_types_, edge_types_;
};

}  // namespace assay::detector
