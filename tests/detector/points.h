// Shorthand for the tests of this folder.
#pragma once

#include "detector/options.h"
#include "detector/step_result.h"
#include "tests/meshes.h"
#include "tests/test.h"

namespace assay::tests {

using detector::MovingPoint, detector::Point;

inline MovingPoint still(Point p) { return {p, p}; }

// The octahedron of radius `r`.
inline detector::Positions octahedron_positions(double r) {
  return positions({{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}});
}

// Returns the octahedron of radius 2 whose vertex 4 is pulled out through a side.
inline detector::Positions pushed_octahedron() {
  detector::Positions x = octahedron_positions(2);
  x.row(4) << 3, .5, -.25;
  return x;
}

// Returns the octahedron of radius 2 with its tip at -z, vertex 5, moved to p. The tip (s, s, s) is
// outside of the triangle at +x +y +z if s is above 2/3.
inline detector::Positions tip_at(const Point& p) {
  detector::Positions x = octahedron_positions(2);
  x.row(5) << p[0], p[1], p[2];
  return x;
}
inline detector::Positions tip_at(double s) { return tip_at({s, s, s}); }

// Return the triangles of two octahedra, and their positions; the second one is moved by `apart`
// along x.
inline detector::Triangles two_octahedra() {
  detector::Triangles t(16, 3);
  t << octahedron(), octahedron().array() + 6;
  return t;
}
inline detector::Positions side_by_side(const detector::Positions& a, const detector::Positions& b,
                                        double apart) {
  detector::Positions x(a.rows() + b.rows(), 3);
  x << a, b.rowwise() + Eigen::RowVector3d(apart, 0, 0);
  return x;
}

// Returns two triangles for each of n x m squares. Both triangles have the first and the last
// vertex of the square. Triangles and the (n+1) x (m+1) vertices are numbered row by row.
inline detector::Triangles squares(std::int32_t n, std::int32_t m) {
  detector::Triangles t(2 * n * m, 3);
  for (std::int32_t s = 0; s < n * m; ++s) {
    const std::int32_t v = s / m * (m + 1) + s % m;
    t.row(2 * s) << v, v + m + 1, v + m + 2;
    t.row(2 * s + 1) << v, v + m + 2, v + 1;
  }
  return t;
}
// Returns the vertices of n x n unit squares.
inline detector::Positions flat_squares(std::int32_t n) {
  detector::Positions x((n + 1) * (n + 1), 3);
  for (std::int32_t v = 0; v < x.rows(); ++v) x.row(v) << v / (n + 1), v % (n + 1), 0;
  return x;
}

// Returns the name of a test that runs with each of several cullings.
inline std::string culling_of_test(const testing::TestParamInfo<detector::Culling>& tested) {
  std::string name = name_of(tested.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// Expects the same answer, and the same pairs in contact at the same times.
inline void expect_same_contacts(const detector::StepResult& a, const detector::StepResult& b) {
  EXPECT_EQ(a.answer, b.answer);
  EXPECT_EQ(a.first, b.first);
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  for (std::size_t i = 0; i < a.pairs.size(); ++i) {
    EXPECT_EQ(a.pairs[i].pair, b.pairs[i].pair);
    EXPECT_EQ(a.pairs[i].time, b.pairs[i].time);
  }
}

// Expects the same contacts, and the same counts of work.
inline void expect_same_work(const detector::StepResult& a, const detector::StepResult& b) {
  expect_same_contacts(a, b);
  EXPECT_EQ(a.signs, b.signs);
  EXPECT_EQ(a.doubts, b.doubts);
  EXPECT_EQ(a.counts.search.box_tests, b.counts.search.box_tests);
  EXPECT_EQ(a.counts.search.candidate_pairs, b.counts.search.candidate_pairs);
  EXPECT_EQ(a.counts.narrow.elementary_tests, b.counts.narrow.elementary_tests);
}

}  // namespace assay::tests
