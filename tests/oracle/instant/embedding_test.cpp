#include "tests/oracle/embedding.h"

#include <gtest/gtest.h>

#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::Positions;
using detector::ViewPrimitive;
using test::positions;
using test::tetrahedron_triangles;
using test::triangles;

Positions tetrahedron(const detector::Point& top) {
  return positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, top});
}

TEST(Embedding, AtTheStart) {
  EXPECT_TRUE(embedded(tetrahedron({1, 1, 3}), tetrahedron_triangles));
  EXPECT_FALSE(embedded(tetrahedron({1, 1, 0}), tetrahedron_triangles));
  EXPECT_FALSE(embedded(test::intersecting_octahedron().x_t0, test::intersecting_octahedron().f));
  EXPECT_FALSE(embedded(tetrahedron({1, 1, 3}), triangles({{0, 1, 2}, {2, 1, 0}})));
}

TEST(Embedding, AtRationalTimes) {
  // The top is in the base at t=1/3, which is no double.
  const auto from = tetrahedron({1, 1, 1}), to = tetrahedron({1, 1, -2});
  EXPECT_TRUE(embedded_at({from, to}, tetrahedron_triangles, {0, 1}));
  EXPECT_TRUE(embedded_at({from, to}, tetrahedron_triangles, {333333333, 1000000000}));
  EXPECT_FALSE(embedded_at({from, to}, tetrahedron_triangles, {1, 3}));
  EXPECT_FALSE(embedded_at({from, to}, tetrahedron_triangles, {2, 6}));
  EXPECT_TRUE(embedded_at({from, to}, tetrahedron_triangles, {333333334, 1000000000}));
  EXPECT_TRUE(embedded_at({from, to}, tetrahedron_triangles, {1, 1}));
}

TEST(Embedding, PairsThatShareAnEdgeOrAVertex) {
  const auto x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {-4, 0, 0}, {0, -4, 0}});
  EXPECT_FALSE(embedded(x, triangles({{0, 1, 2}, {1, 0, 3}})));  // folded flat upon itself
  EXPECT_FALSE(embedded(x, triangles({{0, 1, 2}, {0, 3, 5}})));  // one corner inside the other
  EXPECT_TRUE(embedded(x, triangles({{0, 1, 2}, {0, 4, 5}})));
  EXPECT_TRUE(embedded(x, triangles({{0, 1, 2}, {1, 0, 5}})));
}

bool meets(const ViewPrimitive& primitive, const Positions& to) {
  return meets_primitive({tetrahedron({0, 0, 4}), to}, tetrahedron_triangles, primitive);
}

bool meets(const ViewPrimitive& primitive) { return meets(primitive, tetrahedron({0, 0, 4})); }

ViewPrimitive point(const detector::Point& t0, const detector::Point& t1) {
  return {{t0, t1}, {t0, t1}};
}

ViewPrimitive segment(const detector::Point& a, const detector::Point& b) {
  return {{a, a}, {b, b}};
}

TEST(MeetsPrimitive, Point) {
  EXPECT_FALSE(meets(point({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5})));
  EXPECT_FALSE(meets(point({0.5, 0.5, 0.5}, {1, 1, 1})));
  EXPECT_TRUE(meets(point({0.5, 0.5, 0.5}, {2, 2, 2})));
  EXPECT_TRUE(meets(point({0.5, 0.5, 0.5}, {0.5, 0.5, 0})));                // touches at the end
  EXPECT_TRUE(meets(point({1, 1, 1}, {1, 1, 1}), tetrahedron({0, 0, 1})));  // the face comes
}

TEST(MeetsPrimitive, Segment) {
  EXPECT_FALSE(meets(segment({0.5, 0.5, 0.5}, {1, 1, 1})));
  EXPECT_FALSE(meets(segment({5, 5, 5}, {9, 5, 5})));
  EXPECT_TRUE(meets(segment({0.5, 0.5, 0.5}, {0.5, 0.5, -9})));  // pierces a face at rest
  EXPECT_TRUE(meets(segment({0.5, 0.5, 0.5}, {0.5, 0.5, 0})));   // ends on a face
  EXPECT_TRUE(meets(segment({1, 1, 0}, {2, 1, 0})));             // in the plane of a face, inside
  // An edge of the mesh comes to the segment.
  EXPECT_TRUE(meets(segment({2, -1, 0}, {2, -1, 9}), tetrahedron({8, -4, 4})));
  // A segment with ends that move apart, out through a face.
  EXPECT_TRUE(meets({{{0.5, 0.5, 0.5}, {0.5, 0.5, -1}}, {{1, 1, 1}, {1, 1, 1}}}));
}

}  // namespace
}  // namespace assay::oracle
