// Says which pairs count (L19). A user may leave pairs out of the question whether a mesh meets
// itself.
//
// A pair that does not count is never reported, and it makes no step a collision. By default every
// pair counts. CountedPairs is plain data; mesh_checks.h says which values are refused. It is an
// option of a detector:
//
//   CountedPairs counted;
//   counted.rings = 1;                  // leaves out triangles that share a vertex
//   counted.triangle_pairs = {{0, 5}};  // leaves out triangles 0 and 5
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

// Says whether CountedPairs is about pairs of triangles or about pairs of features. A feature pair
// is a vertex and a face, or two edges, that share no vertex; most detectors filter such pairs. At
// the level `features` two triangles are in contact if a feature pair of the two counts and is in
// contact, and their first time is the least time of these feature pairs. An edge that pierces a
// face at t=0 counts if some feature pair of the two triangles counts.
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

// Says which pairs do not count. "The two" are two triangles or two features, depending on `level`.
struct CountedPairs {
  CountedLevel level = CountedLevel::triangles;

  // For each vertex, the number of its body; if empty, all vertices belong to body 0. The three
  // vertices of a triangle belong to one body. Bodies are numbered from 0 to the greatest number
  // that occurs.
  std::vector<std::int32_t> body;
  // Pairs of bodies, in any order: the two do not count if one is of the first body and the other
  // of the second. If a body is paired with itself, pairs within this body do not count.
  std::vector<std::array<std::int32_t, 2>> apart;

  // The two do not count if a path of fewer than `rings` edges of the mesh joins a vertex of one to
  // a vertex of the other. 0 leaves out nothing, 1 leaves out triangles that share a vertex, 2 also
  // leaves out triangles that an edge joins, and so on.
  std::int32_t rings = 0;

  // The two do not count if their distance at rest is less than this. The comparison is exact: at
  // rest_distance itself they count, and 0 leaves out nothing. Triangles that share a vertex, and
  // triangles that pierce each other, have distance 0.
  double rest_distance = 0;
  std::vector<Point> rest;  // the place of each vertex at rest; may be empty if rest_distance is 0

  // Lists of pairs that do not count, in any order. The first list is for the level `triangles`,
  // the other two are for the level `features`.
  std::vector<TrianglePair> triangle_pairs;
  std::vector<VertexAndFace> vertex_faces;
  std::vector<TwoEdges> edge_pairs;

  // Returns whether every pair counts.
  bool count_all() const {
    return apart.empty() && rings == 0 && rest_distance == 0 && triangle_pairs.empty() &&
           vertex_faces.empty() && edge_pairs.empty();
  }
  friend bool operator==(const CountedPairs&, const CountedPairs&) = default;
};

}  // namespace assay::detector
