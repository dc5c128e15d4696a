// Says which pairs count (L19). A user may leave pairs out of the question whether a mesh meets
// itself.
//
// A pair that does not count is never reported, and it makes no step a collision. Everything counts
// by default. This is plain data; mesh_checks.h says which values are refused. A detector takes it
// when it is made:
//
//   CountedPairs counted;
//   counted.rings = 1;                  // leaves out triangles that share a vertex
//   counted.triangle_pairs = {{0, 5}};  // and these two
//   Options options;
//   options.counted = &counted;
//   Detector detector = Detector::create(triangles, positions, options).value();
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "detector/mesh/enum_names.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"

namespace assay::detector {

// Says which pairs the relation is about. `features` are pairs of a vertex and a face, or of two
// edges, that share no vertex; most detectors filter these. At this level a pair of triangles is in
// contact when one of its counted feature pairs is. Its first time is the least time of these
// feature pairs. An edge that pierces a face at t=0 counts if some feature pair of the two
// triangles does.
enum class CountedLevel : std::uint8_t { triangles, features };
constexpr auto names_of(CountedLevel) {
  using enum CountedLevel;
  return std::to_array<Named<CountedLevel>>({{triangles, "triangles"}, {features, "features"}});
}

// A vertex and a triangle.
struct VertexAndFace {
  std::int32_t vertex = 0, face = 0;
  friend auto operator<=>(const VertexAndFace&, const VertexAndFace&) = default;
};

// Two edges of the mesh by their vertices, in any order.
struct TwoEdges {
  std::array<std::int32_t, 2> a{}, b{};
  friend auto operator<=>(const TwoEdges&, const TwoEdges&) = default;
};

// Below, "the two" are two triangles, or two features, as the level says.
struct CountedPairs {
  CountedLevel level = CountedLevel::triangles;

  // The number of the body of each vertex; if empty, all vertices are of body 0. The vertices of a
  // triangle are of one body. Bodies are numbered from 0 to the greatest number that occurs.
  std::vector<std::int32_t> body;
  // Pairs of bodies that do not meet, in any order. A body paired with itself does not meet itself.
  std::vector<std::array<std::int32_t, 2>> apart;

  // The two do not count if a path of fewer than `rings` edges of the mesh joins a vertex of one to
  // a vertex of the other. 0 leaves out nothing, 1 leaves out triangles that share a vertex, 2 also
  // those that an edge joins, and so on.
  std::int32_t rings = 0;

  // The two do not count if they are nearer to each other at rest than this. The comparison is
  // exact: at rest_distance itself they count, and 0 leaves out nothing. Triangles that share a
  // vertex, and triangles that pierce each other, have distance 0.
  double rest_distance = 0;
  std::vector<Point> rest;  // by vertex, its place at rest; may be empty if rest_distance is 0

  // Pairs that do not count, in any order: of triangles at the level `triangles`, of features at
  // the level `features`.
  std::vector<TrianglePair> triangle_pairs;
  std::vector<VertexAndFace> vertex_faces;
  std::vector<TwoEdges> edge_pairs;

  // Returns whether nothing is left out.
  bool count_all() const {
    return apart.empty() && rings == 0 && rest_distance == 0 && triangle_pairs.empty() &&
           vertex_faces.empty() && edge_pairs.empty();
  }
  friend bool operator==(const CountedPairs&, const CountedPairs&) = default;
};

}  // namespace assay::detector
