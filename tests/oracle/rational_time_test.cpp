// One type of time for all questions about an instant: a time means the same to each of them.
#include "oracle/rational_time.h"

#include "oracle/instant/instant.h"
#include "oracle/referee/static_check.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using Pairs = std::vector<detector::TrianglePair>;

detector::Positions random_places(test::Random& random) {
  detector::Positions x(6, 3);
  for (int v = 0; v < 6; ++v) {
    for (int k = 0; k < 3; ++k) {
      x(v, k) = random_coordinate(random, test::Coordinates::tiny_grid);
    }
  }
  return x;
}

// By CGAL's triangles, pair after pair.
Pairs pairs_that_meet(const detector::Positions& x_t0, const detector::Positions& x_t1,
                      const detector::Triangles& f, const RationalTime& time) {
  Pairs pairs;
  for (std::int32_t a = 0; a < f.rows(); ++a) {
    for (std::int32_t b = a + 1; b < f.rows(); ++b) {
      if (triangles_meet({x_t0, x_t1}, f, {a, b}, time)) pairs.push_back({a, b});
    }
  }
  return pairs;
}

TEST(RationalTime, MeansTheSameToTheInstantAndToTheStaticCheck) {
  test::Random random(71);
  const auto f =
      test::triangles({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {2, 3, 4}, {1, 4, 5}});
  std::size_t meetings = 0;
  bool depends_on_time = false;
  for (int i = 0; i < 100; ++i) {
    const auto x_t0 = random_places(random), x_t1 = random_places(random);
    Pairs first;
    for (const RationalTime& time : {RationalTime{0, 1}, {1, 3}, {2, 4}, {5, 7}, {1, 1}}) {
      const Pairs pairs = contacts_at(Instant({x_t0, x_t1}, time), f);
      EXPECT_EQ(pairs, pairs_that_meet(x_t0, x_t1, f, time))
          << i << ": " << time.numerator << "/" << time.denominator;
      if (time.numerator == 0) first = pairs;
      depends_on_time = depends_on_time || pairs != first;
      meetings += pairs.size();
    }
  }
  EXPECT_GT(meetings, 100);
  EXPECT_TRUE(depends_on_time);
}

TEST(RationalTime, NeedNotBeInLowestTerms) {
  const auto x_t0 = test::positions({{0, 0, 1}}), x_t1 = test::positions({{0, 0, 2}});
  EXPECT_EQ(Instant({x_t0, x_t1}, {1, 2}).box(0).min, Instant({x_t0, x_t1}, {2, 4}).box(0).min);
  EXPECT_EQ(compare(RationalTime{2, 4}, .5), 0);
}

}  // namespace
}  // namespace assay::oracle
