// The static check of triangles at rational times: triangles that share vertices, and triangles
// that have become segments or points.
#include "oracle/referee/static_check.h"

#include <Eigen/Geometry>

#include "oracle/mesh/step.h"
#include "oracle/rational_time.h"
#include "tests/oracle/embedding.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using test::Rows, test::Step, test::positions, test::triangles;

bool meet_at(const Step& step, const StaticTime& time) {
  return triangles_meet({step.x_t0, step.x_t1}, step.f, {0, 1}, time);
}

bool meet_at_rest(Rows rows, test::Corners corners) {
  const auto x = positions(rows);
  return meet_at({x, x, triangles(corners)}, RationalTime{1, 3});
}

TEST(StaticCheck, NoCommonVertex) {
  const auto meet = [](double z) {
    return meet_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, z}, {1, 1, 5}, {2, 1, 5}},
                        {{0, 1, 2}, {3, 4, 5}});
  };
  EXPECT_TRUE(meet(-1));
  EXPECT_TRUE(meet(0));
  EXPECT_FALSE(meet(0x1p-1074));
}

TEST(StaticCheck, ACommonVertexAloneIsNoMeeting) {
  EXPECT_FALSE(meet_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-1, 0, 1}, {0, -1, 1}},
                            {{0, 1, 2}, {0, 3, 4}}));
  // The edge opposite vertex 0 goes through the first triangle.
  EXPECT_TRUE(meet_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}},
                           {{0, 1, 2}, {0, 3, 4}}));
}

TEST(StaticCheck, ACommonEdgeAloneIsNoMeeting) {
  const auto meet = [](double y) {
    return meet_at_rest({{0, 0, 0}, {4, 0, 0}, {2, 4, 0}, {2, y, 0}}, {{0, 1, 2}, {1, 0, 3}});
  };
  EXPECT_FALSE(meet(-1));
  EXPECT_TRUE(meet(1));  // folded onto the other
  EXPECT_TRUE(meet(9));
  EXPECT_TRUE(meet(0));  // on the common edge, which belongs to the other triangle
}

TEST(StaticCheck, FlatTrianglesAreSegmentsAndPoints) {
  EXPECT_TRUE(meet_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 0}, {1, 1, 1}},
                           {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_TRUE(meet_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 0}, {1, 1, 0}},
                           {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_FALSE(meet_at_rest({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
                            {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_TRUE(meet_at_rest({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {3, -1, 0}, {3, 0, 0}, {3, 1, 0}},
                           {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_TRUE(meet_at_rest({{0, 0, 0}, {4, 0, 0}, {2, -1, 0}, {2, 1, 0}}, {{0, 0, 1}, {2, 2, 3}}));
}

TEST(StaticCheck, TimesAreExact) {
  // Vertex 3 reaches the other triangle at t = 1/3, which is no double.
  const auto x_t0 = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, 5}, {2, 1, 5}});
  const auto x_t1 = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -2}, {1, 1, 5}, {2, 1, 5}});
  const Step step = {x_t0, x_t1, triangles({{0, 1, 2}, {3, 4, 5}})};
  constexpr double below = 1.0 / 3;  // the nearest double is below
  EXPECT_FALSE(meet_at(step, below));
  EXPECT_TRUE(meet_at(step, std::nextafter(below, 1.0)));
  EXPECT_TRUE(meet_at(step, RationalTime{1, 3}));
  EXPECT_FALSE(meet_at(step, RationalTime{333333333, 1000000000}));
  EXPECT_EQ(compare(RationalTime{1, 3}, below), 1);
  EXPECT_EQ(compare(RationalTime{1, 2}, .5), 0);
  EXPECT_EQ(compare(.25, .5), -1);
}

TEST(StaticCheck, SameThreeVerticesMeetAtTheStart) {
  const auto x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  EXPECT_TRUE(meet_at({x, x, triangles({{0, 1, 2}, {2, 1, 0}})}, RationalTime{0, 1}));
}

// A tetrahedron, and two triangles that each share an edge with what is there before them.
const auto six_triangles =
    triangles({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {2, 3, 4}, {1, 4, 5}});

// Every meeting at rest is in the pair set of the step, not later, on random tetrahedra pairs.
TEST(StaticCheck, MeetingsAreInThePairSet) {
  test::Random random(51);
  int meetings = 0;
  for (int i = 0; i < 120; ++i) {
    const auto kind = static_cast<test::Coordinates>(i % test::coordinate_kinds);
    detector::Positions x_t0, x_t1;
    place_randomly(random, kind, 6, x_t0, x_t1);
    const StepJudgement judged = judge_step({x_t0, x_t1}, six_triangles, {});
    for (std::int32_t a = 0; a < six_triangles.rows(); ++a) {
      for (std::int32_t b = a + 1; b < six_triangles.rows(); ++b) {
        for (const RationalTime& time : {RationalTime{0, 1}, {2, 7}, {1, 2}, {1, 1}}) {
          if (!triangles_meet({x_t0, x_t1}, six_triangles, {a, b}, time)) continue;
          ++meetings;
          const auto found =
              std::find_if(judged.pairs.begin(), judged.pairs.end(), [&](const auto& p) {
                return p.pair == detector::TrianglePair{a, b};
              });
          ASSERT_NE(found, judged.pairs.end()) << i << ": " << a << " " << b;
          EXPECT_GE(compare(time, found->time.lo), 0) << i << ": " << a << " " << b;
        }
      }
    }
  }
  EXPECT_GT(meetings, 100);
}

// The static test that a sampling detector uses, against rational arithmetic.

TEST(TrianglesMeetNow, AgreesWithRationalArithmeticOnSmallIntegers) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> coordinate(0, 3);
  const auto f = triangles({{0, 1, 2}, {3, 4, 5}});
  int contacts = 0, apart = 0, without_area = 0;
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
    ++(answer ? contacts : apart);
  }
  EXPECT_GT(contacts, 500);
  EXPECT_GT(apart, 500);
  EXPECT_GT(without_area, 20);
}

// One type of time for all questions about an instant: a time means the same to each of them.

using Pairs = std::vector<detector::TrianglePair>;

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
  std::size_t meetings = 0;
  bool depends_on_time = false;
  for (int i = 0; i < 100; ++i) {
    const auto x_t0 = random_rows(random, test::Coordinates::tiny_grid, 6),
               x_t1 = random_rows(random, test::Coordinates::tiny_grid, 6);
    Pairs first;
    for (const RationalTime& time : {RationalTime{0, 1}, {1, 3}, {2, 4}, {5, 7}, {1, 1}}) {
      const Pairs pairs = contacts_at(Instant({x_t0, x_t1}, time), six_triangles);
      EXPECT_EQ(pairs, pairs_that_meet(x_t0, x_t1, six_triangles, time))
          << i << ": " << time.numerator << "/" << time.denominator;
      if (time.numerator == 0) first = pairs;
      depends_on_time = depends_on_time || pairs != first;
      meetings += pairs.size();
    }
  }
  EXPECT_GT(meetings, 100);
  EXPECT_TRUE(depends_on_time);
}

TEST(RationalTime, NeedNotBeInLowestTerms) { EXPECT_EQ(compare(RationalTime{2, 4}, .5), 0); }

}  // namespace
}  // namespace assay::oracle
