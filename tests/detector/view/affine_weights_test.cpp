#include "detector/view/view_anchor.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

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
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    x.row(v) << uniform(engine), uniform(engine), thickness * uniform(engine);
  }
  return cloud(std::move(x));
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
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
  const Point found = combine(affine_weights(c.vertices, c.points, q), c.x);
  EXPECT_LT(distance(found, {.1, .2, 0}), 1e-9);
}

TEST(AffineWeights, FewPointsAndPointsThatCoincide) {
  const Cloud one = cloud(tests::positions({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(combine(affine_weights(one.vertices, one.points, {1, 2, 3}), one.x), (Point{1, 2, 3}));
  const Cloud tetrahedron = cloud(tests::positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
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
}  // namespace assay::detector
