// Distances of features at rest: known ones, at the limit and one step of doubles beside it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "detector/geometry/near_regions.h"

namespace assay::detector {
namespace {

const std::array<Point, 3> face = {Point{0, 0, 0}, Point{4, 0, 0}, Point{0, 4, 0}};

double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

// Nearer than what is just above the distance, and not nearer than the distance.
void expect_distance(const Point& p, double distance) {
  EXPECT_FALSE(vertex_is_nearer_to_face(p, face, distance));
  EXPECT_TRUE(vertex_is_nearer_to_face(p, face, above(distance)));
}

TEST(RestDistance, OfAVertexAndAFaceByEachOfItsParts) {
  expect_distance({1, 1, 3}, 3);    // over the face
  expect_distance({2, -3, 4}, 5);   // beside an edge
  expect_distance({-2, -3, 6}, 7);  // beside a corner
  expect_distance({6, -3, 6}, 7);   // beside another one
  expect_distance({1, 1, 0x1p-1000}, 0x1p-1000);
  EXPECT_TRUE(vertex_is_nearer_to_face({1, 1, 0}, face, std::numeric_limits<double>::denorm_min()));
  const double far = 0x1p1000;
  EXPECT_FALSE(vertex_is_nearer_to_face({1, 1, far}, face, far));
  EXPECT_TRUE(vertex_is_nearer_to_face({1, 1, far}, face, above(far)));
}

TEST(RestDistance, OfAFaceThatHasCollapsed) {
  const std::array<Point, 3> line = {Point{0, 0, 0}, Point{4, 0, 0}, Point{2, 0, 0}};
  EXPECT_FALSE(vertex_is_nearer_to_face({2, 3, 4}, line, 5));
  EXPECT_TRUE(vertex_is_nearer_to_face({2, 3, 4}, line, above(5)));
  const std::array<Point, 3> point = {Point{1, 1, 1}, Point{1, 1, 1}, Point{1, 1, 1}};
  EXPECT_FALSE(vertex_is_nearer_to_face({3, 4, 7}, point, 7));
  EXPECT_TRUE(vertex_is_nearer_to_face({3, 4, 7}, point, above(7)));
}

void expect_distance(const std::array<Point, 2>& a, const std::array<Point, 2>& b,
                     double distance) {
  EXPECT_FALSE(edges_are_nearer(a, b, distance));
  EXPECT_TRUE(edges_are_nearer(a, b, above(distance)));
  EXPECT_FALSE(edges_are_nearer(b, a, distance));
  EXPECT_TRUE(edges_are_nearer(b, a, above(distance)));
}

TEST(RestDistance, OfTwoEdgesByEachOfTheirParts) {
  const std::array<Point, 2> along = {Point{-2, 0, 0}, Point{2, 0, 0}};
  expect_distance(along, {Point{0, -2, 3}, Point{0, 2, 3}}, 3);  // crossing
  expect_distance(along, {Point{0, 3, 4}, Point{0, 9, 4}}, 5);   // an end, and an inner point
  expect_distance(along, {Point{4, 3, 6}, Point{9, 9, 9}}, 7);   // two ends
  expect_distance(along, {Point{-1, 3, 4}, Point{9, 3, 4}}, 5);  // parallel
  expect_distance(along, {Point{1, 3, 4}, Point{1, 3, 4}}, 5);   // a point
}

TEST(RestDistance, OfTwoTriangles) {
  const std::array<Point, 3> over = {Point{1, 1, 2}, Point{5, 5, 9}, Point{5, 6, 9}};
  EXPECT_FALSE(triangles_are_nearer(face, over, 2));
  EXPECT_TRUE(triangles_are_nearer(face, over, above(2)));
  // Their features are 1 apart, but an edge goes through the face.
  const std::array<Point, 3> through = {Point{1, 1, -9}, Point{1, 1, 9}, Point{1.5, 1, 9}};
  EXPECT_TRUE(triangles_are_nearer(face, through, 0.5));
  EXPECT_TRUE(triangles_are_nearer(through, face, 0.5));
}

}  // namespace
}  // namespace assay::detector
