// The points and lines that a search for a view primitive tries, and how they move.
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

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
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
  ASSERT_GT(distance(vertices, triangles), 1e-12);
  for (const auto& mean : {vertices, triangles})
    EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                            [&](const auto& tried) { return distance(tried.q, mean) < 1e-12; }));
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
  std::vector<Ring> rings;
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
  std::vector<Ring> rings;
  constexpr int count = 500;
  for (int k = 0; k < count; ++k) rings.push_back({.08 * k, 2 + std::cos(.08 * k)});
  Positions x = revolved(rings, -.08, .08 * count);
  x.col(0).array() += .02 * x.col(2).array().square();
  const Topology mesh = make_topology(revolved(count), x.rows());
  const auto work_of = [&](auto choose) {
    constexpr std::uint64_t interval = 100'000;  // more than is done between two askings
    std::uint64_t calls = 0;
    const StopFunction stop = [&] { return ++calls, false; };
    PacedStop pace(stop, interval);
    choose(&pace);
    return (calls + 1) * interval / mesh.triangles.size();
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

// Places by weights of vertices, which move with these.

struct Cloud {
  Positions x;
  std::vector<std::int32_t> vertices;
  std::vector<Point> points;
};

Cloud cloud(Positions x) {
  Cloud c{std::move(x), {}, {}};
  for (std::int32_t v = 0; v < c.x.rows(); ++v) {
    c.vertices.push_back(v);
    c.points.push_back(point_of(c.x, v));
  }
  return c;
}

Cloud random_cloud(double thickness) {
  std::mt19937_64 engine(20111);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Positions x(200, 3);
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    x.row(v) << uniform(engine), uniform(engine), thickness * uniform(engine);
  return cloud(std::move(x));
}

TEST(AffineWeights, ReproduceThePointAndSumToOne) {
  const Cloud c = random_cloud(1);
  for (const Point q : {Point{0, 0, 0}, Point{.5, -.3, .2}, Point{.9, .9, -.9}}) {
    const AffineWeights affine = affine_weights(c.vertices, c.points, q);
    EXPECT_LE(affine.vertices.size(), 54u);
    EXPECT_NEAR(std::accumulate(affine.weights.begin(), affine.weights.end(), 0.0), 1, 1e-14);
    EXPECT_LT(distance(combine(affine, c.x), q), 1e-12);
  }
}

TEST(AffineWeights, MoveWithTheVertices) {
  const Cloud c = random_cloud(1);
  const Point q = {.2, .1, -.4};
  const AffineWeights affine = affine_weights(c.vertices, c.points, q);
  Eigen::Matrix3d map;
  map << 2, .5, 0, -.3, 1, .1, 0, 0, 3;
  const Eigen::RowVector3d shift(5, -7, 11);
  const Positions moved = (c.x * map).rowwise() + shift;
  const Eigen::RowVector3d want = Eigen::RowVector3d(q[0], q[1], q[2]) * map + shift;
  EXPECT_LT(distance(combine(affine, moved), {want[0], want[1], want[2]}), 1e-11);
}

TEST(AffineWeights, OfAFlatCloudStayInItsPlane) {
  const Cloud c = random_cloud(0);
  const Point q = {.1, .2, .7};
  EXPECT_LT(distance(combine(affine_weights(c.vertices, c.points, q), c.x), {.1, .2, 0}), 1e-9);
}

TEST(AffineWeights, FewPointsAndPointsThatCoincide) {
  const Cloud one = cloud(positions({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(combine(affine_weights(one.vertices, one.points, {1, 2, 3}), one.x), (Point{1, 2, 3}));
  const Cloud tetrahedron = cloud(positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_LT(distance(combine(affine_weights(tetrahedron.vertices, tetrahedron.points, {.2, .3, .4}),
                             tetrahedron.x),
                     {.2, .3, .4}),
            1e-12);
  // At a vertex.
  EXPECT_LT(distance(combine(affine_weights(tetrahedron.vertices, tetrahedron.points, {1, 0, 0}),
                             tetrahedron.x),
                     {1, 0, 0}),
            1e-6);
}

TEST(AffineWeights, StayFiniteForFinitePositions) {
  const Cloud c = random_cloud(1);
  const AffineWeights affine = affine_weights(c.vertices, c.points, {0, 0, 0});
  const double most = std::numeric_limits<double>::max();
  Positions x = c.x;
  for (double& v : x.reshaped()) v = v > 0 ? most : -most;
  for (const double v : combine(affine, x)) EXPECT_TRUE(std::isfinite(v));
}

}  // namespace
}  // namespace assay::tests
