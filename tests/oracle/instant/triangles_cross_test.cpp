// Triangles that cross or only touch, compared with rational arithmetic.

#include "oracle/instant/instant.h"
#include "oracle/mesh/step.h"
#include "tests/detector/distance/rational_distance.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::PairContact, detector::Positions, detector::Triangles, test::positions,
    test::Random, test::triangles;
using tests::cross, tests::dot, tests::minus, tests::Rational;
using Vector = tests::RationalPoint;

struct Motion {
  Positions x_t0, x_t1;
  Triangles f;
  detector::SteppedMesh stepped() const { return {x_t0, x_t1}; }
  std::vector<PairContact> contacts() const { return judge_step(stepped(), f, {}).pairs; }
  Vector at_start(std::int32_t v) const { return tests::place_at(stepped().path(v), 0); }
};

// Two triangles of random corners, which may share one; every third at rest.
Motion random_motion(Random& random, int i) {
  const auto kind = static_cast<test::Coordinates>(i % test::coordinate_kinds);
  Motion motion;
  place_randomly(random, kind, 6, motion.x_t0, motion.x_t1);
  if (i % 3 == 0) motion.x_t1 = motion.x_t0;
  motion.f = random.below(4) == 0 ? triangles({{0, 1, 2}, {3, 4, 0}})
             : i % 97 == 0        ? triangles({{0, 1, 2}, {1, 0, 2}})
                                  : triangles({{0, 1, 2}, {5, 3, 4}});
  return motion;
}

bool cross_at_rest(test::Rows rows, test::Corners corners = {{0, 1, 2}, {3, 4, 5}}) {
  return triangles_cross(positions(rows), triangles(corners), {0, 1});
}

TEST(TrianglesCross, OnlyIfNoPlaneIsBetweenThem) {
  const auto with_tip_at = [](double z) {
    return cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, z}, {1, 1, 5}, {2, 1, 5}});
  };
  EXPECT_FALSE(with_tip_at(1));
  EXPECT_FALSE(with_tip_at(0));
  EXPECT_TRUE(with_tip_at(-0x1p-1074));
  // Coplanar ones that overlap lie on each other.
  EXPECT_FALSE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {5, 1, 0}, {1, 5, 0}}));
  // An edge crosses an edge, at the rim of both.
  EXPECT_FALSE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, -1}, {2, 0, 1}, {2, -1, 0}}));
  // A triangle without area is the segment or the point that it has become.
  EXPECT_TRUE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {1, 1, 0}}));
  EXPECT_FALSE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 0}, {1, 1, 0}}));
  EXPECT_FALSE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {1, 0, 0}, {9, 0, 0}, {5, 0, 0}}));
  // Those that share a corner, and the same triangle twice.
  EXPECT_TRUE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}},
                            {{0, 1, 2}, {0, 3, 4}}));
  EXPECT_FALSE(cross_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}, {1, 0, 2}}));
}

// By the line in which the planes of two triangles with area meet: on it the triangles have pieces,
// which overlap in more than a point.
bool cross_by_line(const std::array<Vector, 3>& a, const std::array<Vector, 3>& b) {
  const auto normal_of = [](const auto& x) { return cross(minus(x[1], x[0]), minus(x[2], x[0])); };
  const Vector of_a = normal_of(a), of_b = normal_of(b), line = cross(of_a, of_b);
  const auto piece = [&](const auto& corners, const Vector& normal, const Vector& origin) {
    std::vector<Rational> ends;
    int above = 0, below = 0;
    for (int i = 0; i < 3; ++i) {
      const auto &p = corners[i], &q = corners[(i + 1) % 3];
      const Rational h = dot(normal, minus(p, origin)), g = dot(normal, minus(q, origin));
      above += h > 0 ? 1 : 0;
      below += h < 0 ? 1 : 0;
      if (h == 0) ends.push_back(dot(line, p));
      if (h * g < 0) ends.emplace_back(dot(line, p) + h / (h - g) * dot(line, minus(q, p)));
    }
    if (above == 0 || below == 0) ends.clear();
    std::sort(ends.begin(), ends.end());
    return ends;
  };
  const auto on_a = piece(a, of_b, b[0]), on_b = piece(b, of_a, a[0]);
  return !on_a.empty() && !on_b.empty() &&
         std::max(on_a.front(), on_b.front()) < std::min(on_a.back(), on_b.back());
}

TEST(TrianglesCross, AsTheLineOfTheirPlanesSays) {
  Random random(5202);
  int crossing = 0, touching = 0;
  for (int i = 0; i < tests::usual(10000); ++i) {
    const auto motion = random_motion(random, 3 * i);
    std::array<std::array<Vector, 3>, 2> corners;
    bool has_area = true;
    for (int side = 0; side < 2; ++side) {
      auto& x = corners[side];
      for (int k = 0; k < 3; ++k) x[k] = motion.at_start(motion.f(side, k));
      const auto normal = cross(minus(x[1], x[0]), minus(x[2], x[0]));
      has_area = has_area && dot(normal, normal) > 0;
    }
    if (!has_area) continue;
    const bool answer = triangles_cross(motion.x_t0, motion.f, {0, 1});
    EXPECT_EQ(answer, cross_by_line(corners[0], corners[1])) << i;
    const bool meets = !motion.contacts().empty();
    EXPECT_TRUE(meets || !answer) << i;
    crossing += answer ? 1 : 0;
    touching += meets && !answer ? 1 : 0;
  }
  EXPECT_GT(crossing, tests::usual(200));
  EXPECT_GT(touching, tests::usual(50));
}

}  // namespace
}  // namespace assay::oracle
