// The places and lines that a search for a view primitive tries.
#include "detector/view/view_search.h"

#include "detector/view/view_anchor.h"
#include "detector/view/view_signs.h"
#include "tests/detector/points.h"
#include "tests/detector/view/revolved.h"

namespace assay::tests {
namespace {

using namespace detector;

template <class Scored>
bool is_best_first(const std::vector<Scored>& tried) {
  return std::is_sorted(tried.begin(), tried.end(),
                        [](const Scored& a, const Scored& b) { return a.score > b.score; });
}

bool is_near(const Point& a, const Point& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) < 1e-12;
}

// A tube with waists, bent: no point and no line sees all of it.
Positions bent_tube() {
  Positions x = wavy_tube();
  x.col(0).array() += .02 * x.col(2).array().square();
  return x;
}

class Places : public testing::Test {
 protected:
  const Positions x = bent_tube();
  const Topology mesh = make_topology(revolved(tube_rings), x.rows());
  const ViewPlanes planes{mesh, mesh.components[0], x};
  const std::vector<ScoredPoint> points = search_points(planes);
};

TEST_F(Places, HoldTheMeansOfVerticesAndTriangles) {
  ASSERT_TRUE(is_best_first(points));
  Point vertices = {0, 0, 0}, triangles = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    for (const auto& p : planes.points()) vertices[k] += p[k];
    for (std::size_t i = 0; i < planes.size(); ++i) triangles[k] += planes.middle(i)[k];
    vertices[k] /= static_cast<double>(planes.points().size());
    triangles[k] /= static_cast<double>(planes.size());
  }
  ASSERT_FALSE(is_near(vertices, triangles));
  for (const auto& mean : {vertices, triangles}) {
    EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                            [&](const auto& tried) { return is_near(tried.q, mean); }));
  }
}

// 100 places fill the box evenly: each octant gets about one in eight.
TEST_F(Places, FillTheBoxOfTheMesh) {
  Point lo = {1, 1, 1}, hi = {-1, -1, -1};
  for (const auto& p : planes.points()) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  std::array<int, 8> in_octant{};
  for (const auto& [q, score] : points) {
    std::size_t octant = 0;
    bool is_inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      is_inside &= lo[k] <= q[k] && q[k] <= hi[k];
      octant |= static_cast<std::size_t>(2 * q[k] > lo[k] + hi[k]) << k;
    }
    in_octant[octant] += is_inside;
  }
  for (const int count : in_octant) EXPECT_GE(count, 8);
}

TEST_F(Places, LinesGoOnWhileOneMayBeBetter) {
  const auto lines = search_lines(planes, points);
  ASSERT_TRUE(is_best_first(lines));
  EXPECT_GE(lines.size(), 5u + 45u) << "along the tube, and between ten places";
  EXPECT_GT(lines.front().score, lines.back().score);
}

// Wide at both ends: each end sees all but the ring where the other begins. One ring is less than
// what makes a line worth its test, had it not all of them.
TEST(ViewAnchorKind, IsALineWhereThatAloneSeesAll) {
  std::vector<tests::Ring> rings;
  for (int k = 0; k < tube_rings; ++k) rings.push_back({1. * k, k < 4 || k >= 36 ? 3. : 1.5});
  const Positions x = revolved(rings, -1, tube_rings);
  const Topology mesh = make_topology(revolved(tube_rings), x.rows());
  const auto positive_from = [&](const ViewAnchor& anchor) {
    std::vector<ViewSign> signs(mesh.triangles.size());
    ViewCounts counts;
    classify(mesh, mesh.components[0], {x, x}, place_view(anchor, {x, x}), signs, counts);
    return std::count(signs.begin(), signs.end(), ViewSign::positive);
  };
  const auto all = static_cast<long>(mesh.triangles.size());
  const auto point = make_view_anchor(ViewKind::point, mesh, mesh.components[0], x.rows(), x);
  EXPECT_LT(positive_from(point), all);
  EXPECT_GT(positive_from(point), all - all / 30);
  const auto chosen = choose_view_anchor(mesh, mesh.components[0], x.rows(), x);
  EXPECT_EQ(chosen.kind, ViewKind::line);
  EXPECT_EQ(positive_from(chosen), all);
}

// A step of culling bvh is worth 160 box tests a triangle and more (boundary_handler.h), and a
// detector may take three to be created, of which adjacency and tree are one. On all planes lines
// alone would take three.
TEST(ViewAnchorWork, IsLessThanTwoStepsOfBvh) {
  std::vector<tests::Ring> rings;
  constexpr int count = 500;
  for (int k = 0; k < count; ++k) rings.push_back({.08 * k, 2 + std::cos(.08 * k)});
  Positions x = revolved(rings, -.08, .08 * count);
  x.col(0).array() += .02 * x.col(2).array().square();
  const Topology mesh = make_topology(revolved(count), x.rows());
  const auto work_of = [&](auto choose) {
    constexpr std::uint64_t interval = 100'000;  // more than is done between two askings
    std::uint64_t asked = 0;
    const StopFunction stop = [&] { return ++asked, false; };
    PacedStop pace(stop, interval);
    choose(&pace);
    return (asked + 1) * interval / mesh.triangles.size();
  };
  const auto& tube = mesh.components[0];
  for (const auto kind : {ViewKind::point, ViewKind::line}) {
    EXPECT_LT(work_of([&](PacedStop* pace) {
                make_view_anchor(kind, mesh, tube, x.rows(), x, Effort::thorough, pace);
              }),
              320u);
  }
  const auto work = work_of([&](PacedStop* pace) {
    choose_view_anchor(mesh, tube, x.rows(), x, Effort::thorough, pace);
  });
  EXPECT_LT(work, 320u);
  EXPECT_GT(work, 20u) << "or it is not counted";
}

// The corner at +x lies in the planes of four triangles and sees the other four.
TEST(ViewPlanes, WhatIsInThePlaneOfATriangleSeesNoSignOfIt) {
  const Topology mesh = make_topology(octahedron(), 6);
  const ViewPlanes planes(mesh, mesh.components[0], octahedron_positions(1));
  const Point q = {1, 0, 0};
  EXPECT_EQ(planes.score(q, q),
            4 * (ViewPlanes::for_positive + ViewPlanes::for_margin) + 4 * ViewPlanes::for_zero);
}

}  // namespace
}  // namespace assay::tests
