// The distance referee: answers computed by hand, its two proofs compared with rational numbers,
// and its answers compared with exactly sampled distances.
#include "oracle/referee/distance_referee.h"

#include "tests/detector/distance/rational_distance.h"
#include "tests/oracle/query/query_kinds.h"

namespace assay::oracle {
namespace {

using detector::Decision, detector::EdgeEdge, detector::MovingPoint, detector::Point,
    detector::VertexFace, test::edge_edge, test::Random, test::rest, test::vertex_face,
    tests::Rational, tests::squared_distance;

Rational fraction(const RationalTime& t) { return {t.numerator, t.denominator}; }

template <class Query>
void expect_never(const Query& query, const detector::Separation& d) {
  EXPECT_EQ(distance_referee(four_points(query), d).within, Decision::no);
}

// The first time is `first`, a time that the referee finds itself.
template <class Query>
void expect_first_at(const Query& query, const detector::Separation& d, const Rational& first) {
  const DistanceVerdict verdict = distance_referee(four_points(query), d);
  ASSERT_EQ(verdict.within, Decision::yes);
  EXPECT_EQ(fraction(verdict.by), first);
  EXPECT_TRUE(first == 0 ? fraction(verdict.after) == 0 : fraction(verdict.after) < first);
  EXPECT_GE(fraction(verdict.after), first - Rational(0x1p-39));
}

// The first time is between two doubles that differ by little.
template <class Query>
void expect_first_about(const Query& query, const detector::Separation& d, double first) {
  const DistanceVerdict verdict = distance_referee(four_points(query), d);
  ASSERT_EQ(verdict.within, Decision::yes);
  EXPECT_LT(fraction(verdict.after), Rational(first + 0x1p-50));
  EXPECT_GE(fraction(verdict.by), Rational(first - 0x1p-50));
  EXPECT_LE(Rational(fraction(verdict.by) - fraction(verdict.after)), Rational(0x1p-39));
}

VertexFace over_face(const Point& from, const Point& to) {
  return {{from, to}, test::resting_face};
}

TEST(DistanceReferee, VertexAboveAFace) {
  expect_first_at(over_face({1, 1, 2}, {1, 1, 0}), {.5, 0}, Rational(3, 4));
  expect_first_about(over_face({1, 1, 2}, {1, 1, -1}), {1, 0}, 1. / 3);
  expect_first_at(over_face({1, 1, 2}, {1, 1, 1}), {1, 0}, 1);  // closed at t=1
  expect_never(over_face({1, 1, 2}, {1, 1, 1}), {1, -0x1p-1074});
  expect_first_at(over_face({1, 1, 2}, {1, 1, 3}), {2, 0}, 0);  // and at t=0
  expect_first_at(over_face({1, 1, 2}, {1, 1, 0}), {1e300, 1e300}, 0);
}

TEST(DistanceReferee, FeetAtAnEdgeAndAtACorner) {
  // Beyond the edge on the x axis by 3, and 4 above it: from 5 + 3 t to the edge.
  expect_first_at(over_face({1, -3, 8}, {1, -3, 0}), {5, 0}, Rational(1, 2));
  // Corner (4,0,0): the vertex is at (4+2, -3, 6) when 7 away.
  expect_first_at(over_face({6, -3, 8}, {6, -3, 4}), {7, 0}, Rational(1, 2));
  // 1 above the edge: to be 1/sqrt(2) beside it and above it, x = y.
  expect_first_about(over_face({1, -1, 1}, {1, 0, 0}), {1, 0}, 1 - std::sqrt(.5));
}

EdgeEdge falling(const Point& a0, const Point& a1, const Point& b0, const Point& b1) {
  const auto falls = [](const Point& p) { return MovingPoint{p, {p[0], p[1], p[2] - 4}}; };
  return {{falls(a0), falls(a1)}, {rest(b0), rest(b1)}};
}

TEST(DistanceReferee, EdgesCrosswiseParallelAndOfNoLength) {
  expect_first_at(falling({-1, 0, 4}, {1, 0, 4}, {0, -1, 0}, {0, 1, 0}), {1, 0}, Rational(3, 4));
  expect_first_at(falling({0, 0, 4}, {2, 0, 4}, {1, 0, 0}, {3, 0, 0}), {1, 0}, Rational(3, 4));
  // Parallel and beside each other by 3 along them: 5 away at a height of 4, and before.
  expect_first_at(falling({0, 0, 6}, {2, 0, 6}, {5, 0, 0}, {9, 0, 0}), {5, 0}, Rational(1, 2));
  expect_first_at(falling({1, 0, 4}, {1, 0, 4}, {0, 0, 0}, {3, 0, 0}), {2, 0}, Rational(1, 2));
  expect_first_at(falling({1, 0, 4}, {1, 0, 4}, {1, 3, -1}, {1, 3, -1}), {5, 0}, Rational(1, 4));
}

TEST(DistanceReferee, ParallelJustThen) {
  // The edges turn against each other, and are parallel at 1/2, at a distance of 1.
  const EdgeEdge turning = {{{{{-2, -2, 2}, {-2, 2, 0}}, {{2, 2, 2}, {2, -2, 0}}}},
                            {rest({-2, 0, 0}), rest({2, 0, 0})}};
  expect_first_at(turning, {1, 0}, Rational(1, 2));
}

TEST(DistanceReferee, AFaceThatCollapses) {
  // At 1/2 the face is a segment on the x axis, over whose middle the vertex then is, 1 away.
  const VertexFace flat = {{{0, 0, 2}, {0, 0, 0}},
                           {rest({-2, 0, 0}), rest({2, 0, 0}), {{0, 5, 0}, {0, -5, 0}}}};
  expect_first_at(flat, {1, 0}, Rational(1, 2));
  // A point throughout.
  const VertexFace point = {{{0, 3, 8}, {0, 3, 0}}, {rest({}), rest({}), rest({})}};
  expect_first_at(point, {5, 0}, Rational(1, 2));
}

TEST(DistanceReferee, TouchesTheDistanceAndGoesAway) {
  // Along a line past a corner, at a distance of 5 at 1/2 and at 1/3, and never nearer.
  const auto past = [](double from, double to) {
    return VertexFace{{{from, 3, 4}, {to, 3, 4}}, {rest({}), rest({0, -1, 0}), rest({0, 0, -1})}};
  };
  expect_first_at(past(-1, 1), {5, 0}, Rational(1, 2));
  expect_first_at(past(-1, 2), {5, 0}, Rational(1, 3));
  expect_never(past(-1, 1), {5, -0x1p-100});
  // sqrt(25 + x^2) = 13 at x = -12, from -13 to 13.
  expect_first_at(past(-13, 19), {13, 0}, Rational(1, 32));
}

TEST(DistanceReferee, AtRest) {
  expect_first_at(over_face({1, 1, 2}, {1, 1, 2}), {2, 0}, 0);
  expect_first_at(over_face({6, -3, 6}, {6, -3, 6}), {7, 0}, 0);
  expect_never(over_face({6, -3, 6}, {6, -3, 6}), {7, -0x1p-500});
  expect_never(over_face({1, 1, 2}, {1, 1, 2}), {2, -0x1p-1074});
  expect_first_at(over_face({1, 1, 2}, {1, 1, 2}), {2, 0x1p-1074}, 0);
}

TEST(DistanceReferee, WithoutDistanceItFindsContacts) {
  expect_first_at(over_face({1, 1, 1}, {1, 1, -1}), {0, 0}, Rational(1, 2));
  expect_never(over_face({3, 3, 1}, {3, 3, -1}), {0, 0});
  // At a time that no fraction shows: z = 0 where 10 t = 3 along a slanted way, with d tiny.
  for (const detector::Separation& d :
       {detector::Separation{0, 0}, detector::Separation{0x1p-1074, 0}}) {
    const VertexFace through = {{{1, 1, .3}, {1.1, .9, -.7}}, over_face({0, 0, 0}, {0, 0, 0}).face};
    expect_first_about(through, d, .3);
    const double third = 1. / 3;
    expect_first_about(VertexFace{{{1, 1, third}, {1.1, .9, third - 1}}, through.face}, d, third);
  }
}

TEST(DistanceReferee, AllDoubles) {
  constexpr double huge = 0x1.fffffffffffffp1023, tiny = 0x1p-1074;
  // The differences overflow.
  const VertexFace wide = {
      {{0, 0, huge}, {0, 0, -huge}},
      {rest({-huge, -huge, -huge}), rest({huge, -huge, -huge}), rest({0, huge, -huge})}};
  expect_first_at(wide, {huge, 0}, Rational(1, 2));
  expect_first_at(over_face({1, 1, tiny}, {1, 1, 1}), {tiny, 0}, 0);
  expect_never(over_face({1, 1, 2 * tiny}, {1, 1, 1}), {tiny, 0});
  const VertexFace smallest = {
      {{0, 0, 4 * tiny}, {0, 0, 0}},
      {rest({-tiny, -tiny, 0}), rest({tiny, -tiny, 0}), rest({0, tiny, 0})}};
  expect_first_at(smallest, {tiny, 0}, Rational(3, 4));
  expect_first_at(smallest, {0, 0}, 1);
}

// Past a corner along a line: within d for about 2^-28 of the step.
TEST(DistanceReferee, AShortTime) {
  const VertexFace corner = {{{-1, 3, 4}, {1.3, 3, 4}},
                             {rest({}), rest({0, -1, 0}), rest({0, 0, -1})}};
  const DistanceVerdict verdict = distance_referee(four_points(corner), {5, 0x1p-64});
  ASSERT_EQ(verdict.within, Decision::yes);
  EXPECT_NEAR(static_cast<double>(fraction(verdict.by)), 1 / 2.3, 0x1p-28);
  expect_never(corner, {5, -0x1p-64});
}

TEST(DistanceReferee, LessWorkOnlyLeavesMoreOpen) {
  Random random(71);
  for (int i = 0; i < 200; ++i) {
    const detector::FourPoints q = {random_query(random, test::QueryKind::generic, 1), 1};
    const detector::Separation d = {random.below(8) / 16., 0};
    const DistanceVerdict full = distance_referee(q, d);
    for (const DistanceRefereeOptions& less :
         {DistanceRefereeOptions{.depth = 3}, DistanceRefereeOptions{.max_cells = 4}}) {
      const DistanceVerdict part = distance_referee(q, d, less);
      EXPECT_TRUE(part.within == full.within || part.within == Decision::open) << i;
      EXPECT_LE(fraction(part.after), fraction(full.by));
    }
    const DistanceVerdict none = distance_referee(q, d, {.max_cells = 0});
    EXPECT_NE(none.within, Decision::no);
    EXPECT_EQ(fraction(none.after), 0);
  }
}

// The double proofs claim nothing that integers refute: where they are put next to a distance that
// is at the limit, within 24 and 8 units in the last place of a sum of sizes.
TEST(DistanceProofs, DoublesDoNotClaimWhatTheyCannotTell) {
  Random random(72);
  int near = 0, apart = 0, doubtful = 0;
  for (int i = 0; i < tests::usual(6000); ++i) {
    const auto kind = static_cast<test::Coordinates>(random.below(test::coordinate_kinds));
    std::array<MovingPoint, 4> x;
    for (auto& p : x) p = test::random_point(random, kind);
    const detector::FourPoints points = {x, 1 + i % 2};
    const int depth = 1 + random.below(30);
    const std::int64_t k = random.below(1 << depth);
    const double s = std::ldexp(static_cast<double>(k), -depth), e = s + std::ldexp(1, -depth);
    const Rational at_s = squared_distance(points, Rational(s));
    const Rational at_e = squared_distance(points, Rational(e));
    // Beside the lesser distance by 2^-30 to 2^-53 of it.
    const double part = std::ldexp(random.below(2) == 0 ? 1 : -1, -30 - random.below(24));
    const double d = std::sqrt(static_cast<double>(std::min(at_s, at_e))) * (1 + part);
    if (!(d > 0)) continue;
    const DoubleReach reach = double_reach(points, {d, 0});
    const Rational limit = Rational(d) * Rational(d);
    const Decision quick = near_in_double(reach, s, 0);
    EXPECT_TRUE(quick != Decision::yes || at_s <= limit) << i;
    near += quick == Decision::yes;
    doubtful += quick == Decision::open;
    if (apart_in_double(reach, s, e) == SeparationProof::separated) {
      EXPECT_GT(at_s, limit) << i;
      EXPECT_GT(at_e, limit) << i;
      EXPECT_GT(squared_distance(points, Rational(s / 2 + e / 2)), limit) << i;
      ++apart;
    }
    const IntegerReach exact = integer_reach(points, {d, 0});
    EXPECT_EQ(near_in_integers(exact, {k, std::int64_t{1} << depth}), at_s <= limit) << i;
  }
  EXPECT_GT(near, tests::usual(200));
  EXPECT_GT(apart, tests::usual(200));
  EXPECT_GT(doubtful, tests::usual(200));
}

// A direction that turns with the face keeps the vertex away over the whole step.
TEST(DistanceProofs, OneDirectionThatTurns) {
  const detector::FourPoints turning = {{{rest({.5, 0, 3}),
                                          {{-1, -1, 0}, {-1, -1, .5}},
                                          {{2, -1, 0}, {2, -1, -.5}},
                                          rest({0, 2, 0})}},
                                        1};
  EXPECT_EQ(apart_in_double(double_reach(turning, {2.7, 0}), 0, 1), SeparationProof::separated);
  EXPECT_TRUE(apart_in_integers(integer_reach(turning, {2.7, 0}), 0, 0));
  EXPECT_NE(apart_in_double(double_reach(turning, {3, 0}), 0, 1), SeparationProof::separated);
  EXPECT_FALSE(apart_in_integers(integer_reach(turning, {3, 0}), 0, 0));
}

// The distance at times up to which nothing is near, and at the time by which something is.
TEST(DistanceReferee, ExactSamplesOfSmallIntegers) {
  Random random(73);
  int near = 0, far = 0, open = 0;
  for (int i = 0; i < tests::usual(20'000); ++i) {
    SCOPED_TRACE(i);
    const int first_group = 1 + i % 2;
    const test::Points x = random_query(random, test::QueryKind::small_integers, first_group);
    const detector::FourPoints points = {x, first_group};
    const double whole = random.below(5);
    const detector::Separation d = {random.below(3) == 0 ? std::sqrt(whole) : whole / 2,
                                    random.below(8) == 0 ? 0x1p-60 : 0};
    const DistanceVerdict verdict = distance_referee(points, d);
    const Rational sum = Rational(d.first) + Rational(d.second), limit = sum * sum,
                   after = fraction(verdict.after), by = fraction(verdict.by);
    const Rational any = Rational(random.below(61), 60);
    if (verdict.within == Decision::no) {
      ++far;
      EXPECT_GT(squared_distance(points, any), limit);
      continue;
    }
    (verdict.within == Decision::yes ? near : open) += 1;
    if (by == 0 && verdict.within == Decision::yes) {
      EXPECT_LE(squared_distance(points, 0), limit);
      continue;
    }
    EXPECT_GT(squared_distance(points, after), limit);
    EXPECT_GT(squared_distance(points, after * any), limit);
    // A contact may be known without a time at which d is reached.
    EXPECT_TRUE(verdict.within != Decision::yes || limit <= 0x1p-20 ||
                squared_distance(points, by) <= limit);
  }
  EXPECT_GT(near, tests::usual(4'000));
  EXPECT_GT(far, tests::usual(2'000));
  EXPECT_LT(open, 200);
}

}  // namespace
}  // namespace assay::oracle
