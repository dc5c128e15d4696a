// The static test that a sampling detector uses, against rational arithmetic.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "oracle/referee/static_check.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

TEST(TrianglesMeetNow, AgreesWithRationalArithmeticOnSmallIntegers) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> coordinate(0, 3);
  const auto f = test::triangles({{0, 1, 2}, {3, 4, 5}});
  int met = 0, apart = 0, without_area = 0;
  for (int i = 0; i < 3000; ++i) {
    detector::Positions x(6, 3);
    for (Eigen::Index k = 0; k < x.size(); ++k) x.data()[k] = coordinate(random);
    const auto is_flat = [&](Eigen::Index v) {
      const Eigen::RowVector3d a = x.row(v), b = x.row(v + 1), c = x.row(v + 2);
      return (b - a).cross(c - a).isZero(0);
    };
    const bool answer = assay_triangles_meet_now(x.data(), x.data() + 9) != 0;
    if (is_flat(0) || is_flat(3)) {
      EXPECT_FALSE(answer);
      ++without_area;
      continue;
    }
    EXPECT_EQ(answer, triangles_meet({x, x}, f, {0, 1}, RationalTime{0, 1})) << x;
    ++(answer ? met : apart);
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(apart, 500);
  EXPECT_GT(without_area, 20);
}

}  // namespace
}  // namespace assay::oracle
