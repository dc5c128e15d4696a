// Winding numbers, and distances of features at rest.
#include <random>

#include "detector/geometry/near_regions.h"
#include "detector/geometry/orientation.h"
#include "detector/geometry/winding.h"
#include "tests/asked.h"
#include "tests/detector/points.h"
#include "tests/detector/view/revolved.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions;
using Windings = std::vector<std::optional<int>>;

TEST(Winding, InsideOutsideAndInward) {
  const Positions x = octahedron_positions(2);
  Triangles t = octahedron();
  const Topology mesh = make_topology(t, 6);
  const auto& all = mesh.components[0].triangles;
  EXPECT_EQ(winding_number(mesh, all, x, {0, 0, 0}), 1);
  EXPECT_EQ(winding_number(mesh, all, x, {.5, .25, -.125}), 1);
  EXPECT_EQ(winding_number(mesh, all, x, {3, 0, 0}), 0);
  EXPECT_EQ(winding_number(mesh, all, x, {1, 1, 1}), 0);
  EXPECT_EQ(winding_number(mesh, all, x, {1, .5, .5}), std::nullopt) << "on the surface";
  EXPECT_EQ(winding_numbers_outside(mesh, all, x, all), Windings(8, 0));
  t.col(1).swap(t.col(2));
  const Topology inward = make_topology(t, 6);
  EXPECT_EQ(winding_number(inward, all, x, {0, 0, 0}), -1);
  EXPECT_EQ(winding_numbers_outside(inward, all, x, all), Windings(8, -1));
}

TEST(Winding, FarFromTheOriginAndTiny) {
  const Topology mesh = make_topology(octahedron(), 6);
  Positions x = octahedron_positions(1);
  x.array() += 0x1p50;
  EXPECT_EQ(winding_number(mesh, mesh.components[0].triangles, x, {0x1p50, 0x1p50, 0x1p50}), 1);
  const Positions tiny = octahedron_positions(0x1p-1070);
  EXPECT_EQ(winding_number(mesh, mesh.components[0].triangles, tiny, {0, 0, 0}), 1);
  EXPECT_EQ(winding_number(mesh, mesh.components[0].triangles, tiny, {0x1p-1000, 0, 0}), 0);
}

TEST(Sides, OfAllAxesAtOnceAreThoseOfEach) {
  std::mt19937 random(1);
  for (int i = 0; i < 3'000; ++i) {
    Point p[3];
    for (std::size_t k = 0; k < 3; ++k) {
      // 1 is in the range of the bound; 2^-530 and 2^530 are out of it.
      const int exponent = 530 * (static_cast<int>(random() % 3) - 1);
      for (auto& point : p) point[k] = std::ldexp(static_cast<double>(random() % 5), exponent);
    }
    std::array<int, 3> sides;
    normal_and_sides(p[0], p[1], p[2], sides);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(sides[k], sure_side(p[0], p[1], p[2], k));
  }
}

// A triangle that has become a point crosses no ray, and must not spoil every one.
TEST(Winding, CollapsedTrianglesDoNotCount) {
  const Topology mesh = make_topology(octahedron(), 6);
  Positions x = octahedron_positions(2);
  x.row(0) = x.row(2) = x.row(4);  // triangle 0 is a point, its neighbours are segments
  const auto& all = mesh.components[0].triangles;
  EXPECT_TRUE(has_zero_area(mesh, x, 0));
  EXPECT_FALSE(has_zero_area(mesh, x, 6));
  EXPECT_EQ(winding_number(mesh, all, x, {-.1, -.1, 0}), 1);
  EXPECT_EQ(winding_number(mesh, all, x, {-5, 0, 0}), 0);
}

// By every triangle, along directions of its own. Nothing where all of these meet an edge.
std::optional<int> counted(const Topology& mesh, const PositionsView& x, const RayOrigin& origin,
                           int skipped = -1) {
  for (const RayDirection towards : {RayDirection{7, -3, 5}, {-2, 11, 1}, {1, 4, -13}}) {
    RayDirection r = towards;
    const auto signs = [&](std::size_t t) {
      const auto& v = mesh.triangles[t];
      return crossing_signs({point_of(x, v[0]), point_of(x, v[1]), point_of(x, v[2])}, origin, r,
                            Arithmetic::exact);
    };
    if (skipped >= 0 && signs(static_cast<std::size_t>(skipped))[0] < 0) {
      for (int& k : r) k = -k;
    }
    int sum = 0;
    bool is_clear = true;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (static_cast<int>(t) == skipped) continue;
      const auto s = signs(t);
      const bool inside = s[0] != 0 && s[0] == s[1] && s[1] == s[2];
      const bool beside = (s[0] > 0 || s[1] > 0 || s[2] > 0) && (s[0] < 0 || s[1] < 0 || s[2] < 0);
      is_clear = is_clear && (beside || (inside && s[3] != 0));
      if (inside && s[3] == s[0]) sum += s[0];
    }
    if (is_clear) return sum;
  }
  return std::nullopt;
}

// The boxes of the plane that rays are seen in reject nothing that a ray crosses: at ordinary
// sizes, far away, among denormals and next to the largest double.
TEST(Winding, RaysMeetWhatEveryTriangleSays) {
  std::mt19937_64 engine(2011);
  std::uniform_int_distribution<int> noise(-40, 40);
  const Topology mesh = make_topology(tests::revolved(6), 6 * tests::sides + 2);
  const auto& all = mesh.components[0].triangles;
  struct Place {
    double scale, offset;
  };
  int compared = 0;
  for (const Place place : {Place{1, 0}, {0x1p-3, 0x1p48}, {0x1p-1074, 0}, {0x1p1014, 0}}) {
    for (int i = 0; i < tests::usual(40); ++i) {
      Positions x(6 * tests::sides + 2, 3);
      for (Eigen::Index k = 0; k < x.size(); ++k)
        x.data()[k] = place.scale * noise(engine) + place.offset;
      const auto outside = winding_numbers_outside(mesh, all, x, all);
      for (std::size_t t = 0; t < outside.size(); ++t) {
        const auto& v = mesh.triangles[t];
        const RayOrigin origin = {point_of(x, v[0]), point_of(x, v[1]), point_of(x, v[2])};
        const auto truth = counted(mesh, x, origin, static_cast<int>(t));
        if (!truth || !outside[t]) continue;
        ASSERT_EQ(outside[t], truth) << place.scale << ", mesh " << i << ", triangle " << t;
        ++compared;
      }
      const Point point = {place.offset, place.offset, place.offset};
      const auto winding = winding_number(mesh, all, x, point);
      const auto truth = counted(mesh, x, {point, point, point});
      if (!winding || !truth) continue;
      ASSERT_EQ(winding, truth) << place.scale << ", mesh " << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, tests::usual(12000));
}

// What is asked beside a triangle does not change its number.
TEST(Winding, TogetherAsAlone) {
  const Topology mesh = make_topology(tests::revolved(4), 4 * tests::sides + 2);
  const auto& all = mesh.components[0].triangles;
  std::mt19937_64 engine(7);
  std::uniform_int_distribution<int> noise(-5, 5);  // often on edges: directions are given up
  for (int i = 0; i < 60; ++i) {
    Positions x(4 * tests::sides + 2, 3);
    for (Eigen::Index k = 0; k < x.size(); ++k) x.data()[k] = noise(engine);
    for (const auto arithmetic : {Arithmetic::exact, Arithmetic::bounded}) {
      const auto together = winding_numbers_outside(mesh, all, x, all, arithmetic);
      for (std::size_t k = 0; k < all.size(); ++k)
        ASSERT_EQ(together[k], winding_numbers_outside(mesh, all, x, {{all[k]}}, arithmetic)[0])
            << "mesh " << i << ", triangle " << all[k];
    }
  }
}

// Distances of features at rest: known ones, at the limit and one step of doubles beside it.

const std::array<Point, 3> face = {Point{0, 0, 0}, Point{4, 0, 0}, Point{0, 4, 0}};

double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

// Nearer than what is just above the distance, and not nearer than the distance.
void expect_distance(const Point& p, double distance, const std::array<Point, 3>& to = face) {
  EXPECT_FALSE(vertex_is_nearer_to_face(p, to, distance));
  EXPECT_TRUE(vertex_is_nearer_to_face(p, to, above(distance)));
}

TEST(RestDistance, OfAVertexAndAFaceByEachOfItsParts) {
  expect_distance({1, 1, 3}, 3);    // over the face
  expect_distance({2, -3, 4}, 5);   // beside an edge
  expect_distance({-2, -3, 6}, 7);  // beside a corner
  expect_distance({6, -3, 6}, 7);   // beside another one
  expect_distance({1, 1, 0x1p-1000}, 0x1p-1000);
  EXPECT_TRUE(vertex_is_nearer_to_face({1, 1, 0}, face, std::numeric_limits<double>::denorm_min()));
  expect_distance({1, 1, 0x1p1000}, 0x1p1000);
  // Of a face that has collapsed to a line, and to a point.
  expect_distance({2, 3, 4}, 5, {Point{0, 0, 0}, Point{4, 0, 0}, Point{2, 0, 0}});
  expect_distance({3, 4, 7}, 7, {Point{1, 1, 1}, Point{1, 1, 1}, Point{1, 1, 1}});
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
