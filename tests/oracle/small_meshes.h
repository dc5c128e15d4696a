// Meshes of a few triangles, written as lists.
#pragma once

#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::oracle::test {

using Rows = std::initializer_list<detector::Point>;
using Corners = std::initializer_list<tests::Corners>;
using tests::positions, tests::triangles;

// A tetrahedron of the vertices 0 to 3 whose normals point outward.
inline const detector::Triangles tetrahedron_triangles =
    triangles({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});

struct Step {
  detector::Positions x_t0, x_t1;
  detector::Triangles f;
};

// Returns whether both lists hold the same contacts, to the last bit.
inline bool same(const std::vector<detector::PairContact>& a,
                 const std::vector<detector::PairContact>& b) {
  const auto key = [](const detector::PairContact& c) {
    return std::tie(c.pair.a, c.pair.b, c.time.lo, c.time.hi, c.feature.kind, c.feature.vertices);
  };
  return std::ranges::equal(a, b, {}, key, key);
}

// Returns a tetrahedron whose vertices pass through its faces, with two contacts one after the
// other.
inline Step turning_tetrahedron() {
  return {positions({{3, 2, 4}, {3, -2, -2}, {-2, 2, -2}, {-1, -2, 4}}),
          positions({{-3, -1, 3}, {-4, 3, -8}, {2, -6, 3}, {1, 1, -1}}),
          triangles({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})};
}

// Returns an octahedron that collapses through itself, with later contacts after the first one.
inline Step collapsing_octahedron() {
  return {
      positions({{4, 0, 0}, {-3, 0, 0}, {1, 4, 1}, {0, -4, -1}, {0, -1, 3}, {0, 0, -2}}),
      positions({{4, 0, 0}, {3, -1, -3}, {-5, 1, -9}, {-3, -2, 3}, {-6, -11, -1}, {-10, -6, -8}}),
      tests::octahedron()};
}

// Returns an octahedron that intersects itself at the start: an edge pierces three faces.
inline Step intersecting_octahedron() {
  return {positions({{1, -2, 0}, {-2, 1, 1}, {-2, 5, -2}, {2, -2, -1}, {0, 0, 1}, {-1, 0, -4}}),
          positions({{1, -2, 0}, {-2, 1, 1}, {0, 6, -2}, {2, -2, -1}, {0, 0, 1}, {-1, 0, -4}}),
          tests::octahedron()};
}

// Returns seven vertices that are seen from a segment. One triangle has no sign, although each of
// its vertices alone has one.
inline Step seven_vertices_about_a_line() {
  return {
      positions(
          {{4, 0, 2}, {2, 7, 2}, {-5, 5, -2}, {-2, -5, -2}, {-1, -6, -2}, {2, 1, 6}, {-2, 2, -6}}),
      tests::positions_of("6 -3 -1, 2 7 2, -5 5 -2, -2 -5 -2, 1 -10 -5, 2 1 6, -6 -1 -3"),
      tests::triangles_of("0 1 5, 1 0 6, 1 2 5, 1 6 2, 2 3 5, 3 2 6, 3 4 5, 4 3 6, 4 0 5, 0 4 6")};
}

}  // namespace assay::oracle::test
