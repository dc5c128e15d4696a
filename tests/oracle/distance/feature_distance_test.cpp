// Times and distances computed by hand, for each region and for each mistake that is possible in a
// region.
#include "oracle/distance/feature_distance.h"

#include "oracle/query/integer_polynomial.h"
#include "oracle/query/times/times.h"
#include "tests/oracle/query/query_kinds.h"

namespace assay::oracle {
namespace {

using detector::FourPoints, detector::MovingPoint, detector::Point, detector::TimeEnclosure,
    test::rest;

constexpr TimeEnclosure half = {0.5, 0.5};
constexpr double infinity = std::numeric_limits<double>::infinity();

using MovingFace = std::array<MovingPoint, 3>;

FourPoints vertex_face(const MovingPoint& p, const MovingFace& f) {
  return {{p, f[0], f[1], f[2]}, 1};
}

// Asked with the vertices of the face in every order.
void expect_first(const MovingPoint& p, const MovingFace& f, double d, const TimeEnclosure& first) {
  for (int i = 0; i < 3; ++i) {
    for (const int turn : {1, 2}) {
      const MovingFace turned = {f[i], f[(i + turn) % 3], f[(i + 2 * turn) % 3]};
      const ContactAnswer answer = first_time_within(vertex_face(p, turned), {d, 0});
      EXPECT_TRUE(answer.contact) << d;
      EXPECT_EQ(answer.first, first) << d << " " << answer.first.lo;
    }
  }
}

void expect_apart(const FourPoints& q, const Separation& d) {
  EXPECT_FALSE(first_time_within(q, d).contact);
  EXPECT_FALSE(first_time_within(q, d, detector::Want::yes_no).contact);
}

using MovingEdge = std::array<MovingPoint, 2>;

// Asked with the ends and the edges in every order.
void expect_first(const MovingEdge& a, const MovingEdge& b, const Separation& d,
                  const TimeEnclosure& first) {
  for (const int i : {0, 1}) {
    for (const int j : {0, 1}) {
      for (const FourPoints& q : {FourPoints{{a[i], a[1 - i], b[j], b[1 - j]}, 2},
                                  FourPoints{{b[j], b[1 - j], a[i], a[1 - i]}, 2}}) {
        const ContactAnswer answer = first_time_within(q, d);
        EXPECT_TRUE(answer.contact);
        EXPECT_EQ(answer.first, first) << answer.first.lo;
      }
    }
  }
}

TimeEnclosure about(double t) { return {std::nextafter(t, 0), t}; }

TEST(FeatureDistance, PointAboveTheInsideOfAFace) {
  const MovingPoint falling = {{1, 1, 3}, {1, 1, -1}};  // at height 3 - 4t
  expect_first(falling, test::resting_face, 1, half);
  expect_first(falling, test::resting_face, 0.5, {0.625, 0.625});
  expect_first(falling, test::resting_face, 0, {0.75, 0.75});
  expect_first(falling, test::resting_face, 3, {0, 0});
  expect_first(falling, test::resting_face, 100, {0, 0});
}

TEST(FeatureDistance, PointBesideAnEdgeOfAFace) {
  expect_first({{2, -6, 8}, {2, 0, 0}}, test::resting_face, 5, half);  // 10 (1 - t) from the edge
  // In the plane of the face, where the height is 0: only the foot tells.
  expect_first({{2, -3, 0}, {2, 1, 0}}, test::resting_face, 1, half);
  // (6 - 8t) / sqrt 2 from the long edge, and the double nearest to sqrt 2 is above it.
  expect_first({{5, 5, 0}, {1, 1, 0}}, test::resting_face, std::sqrt(2.0), about(0.5));
}

TEST(FeatureDistance, PointBesideAVertexOfAFace) {
  // 9 (1 - t) from the vertex 0. The line of the edge 0 1 is nearer, and is reached outside of it.
  const MovingPoint coming = {{-6, -3, -6}, {0, 0, 0}};
  expect_first(coming, test::resting_face, 4.5, half);
  const ContactAnswer third = first_time_within(vertex_face(coming, test::resting_face), {3, 0});
  EXPECT_EQ(third.first, (TimeEnclosure{2.0 / 3, std::nextafter(2.0 / 3, 1)}));
}

const MovingEdge along_x = {rest({-2, 0, 0}), rest({2, 0, 0})};

TEST(FeatureDistance, EdgesThatCross) {
  const MovingEdge along_y = {MovingPoint{{0, -2, 3}, {0, -2, -1}},
                              MovingPoint{{0, 2, 3}, {0, 2, -1}}};
  expect_first(along_x, along_y, {1, 0}, half);
  expect_first(along_x, along_y, {0.75, 0.25}, half);
  expect_first(along_x, along_y, {0, 0}, {0.75, 0.75});
}

TEST(FeatureDistance, EdgesThatDoNotCross) {
  // The end of one is beside the other.
  expect_first(along_x, {MovingPoint{{1, 5, 0}, {1, 1, 0}}, MovingPoint{{1, 9, 0}, {1, 5, 0}}},
               {3, 0}, half);
  // Both ends: one is 9 (1 - t) from that of the other; the lines are nearer.
  expect_first({rest({0, 0, 0}), rest({2, 0, 0})},
               {MovingPoint{{-6, -3, -6}, {0, 0, 0}}, MovingPoint{{-7, -3, -6}, {-1, 0, 0}}},
               {4.5, 0}, half);
  // They stay parallel.
  expect_first(along_x, {MovingPoint{{-1, 0, 3}, {-1, 0, -1}}, MovingPoint{{5, 0, 3}, {5, 0, -1}}},
               {1, 0}, half);
}

// At 1/2 the edges are parallel, N is zero, f is zero, and all conditions but the strict one hold.
TEST(FeatureDistance, NormalThatVanishesIsNoNearness) {
  const MovingPoint a = rest({-20, 0, 0}), b = rest({20, 0, 0});
  const FourPoints edges = {{a, b, {{-20, -20, 9}, {-20, 20, 9}}, {{20, 20, 9}, {20, -20, 9}}}, 2};
  expect_apart(edges, {1, 0});
  constexpr int both = 8, inside = 6;
  const Region of_edges = Regions(edges, {1, 0})[both];
  EXPECT_EQ(sign_at(of_edges.f, 0.5), 0);
  EXPECT_FALSE(first_zero(of_edges, 0, 1));
  // A face that is a segment at 1/2, and a point beside it.
  const FourPoints face = {{rest({0, 0, 9}), a, b, {{0, -20, 0}, {0, 20, 0}}}, 1};
  expect_apart(face, {1, 0});
  const Region of_face = Regions(face, {1, 0})[inside];
  EXPECT_EQ(sign_at(of_face.f, 0.5), 0);
  EXPECT_FALSE(first_zero(of_face, 0, 1));
}

// Far at both ends, near in between.
TEST(FeatureDistance, NearOnlyInBetween) {
  // p = (24t - 10, 1, 1), within 2 of the edge x = 0 where |24t - 10| <= sqrt 3.
  const ContactAnswer answer =
      first_time_within(vertex_face({{-10, 1, 1}, {14, 1, 1}}, test::resting_face), {2, 0});
  ASSERT_TRUE(answer.contact);
  EXPECT_NEAR(answer.first.lo, (10 - std::sqrt(3.0)) / 24, 1e-15);
  EXPECT_EQ(answer.first.hi, std::nextafter(answer.first.lo, 1));
}

// A passing point is at d at one time only: a zero of even order.
TEST(FeatureDistance, TouchAtExactlyD) {
  const MovingFace below = {rest({0, 0, 0}), rest({1, -5, 0}), rest({-1, -5, 0})};
  const MovingPoint passing = {{-1, 3, 0}, {1, 3, 0}};
  expect_first(passing, below, 3, half);
  expect_apart(vertex_face(passing, below), {std::nextafter(3.0, 0), 0});
  // At 1/3, which is no double.
  const ContactAnswer third =
      first_time_within(vertex_face({{-1, 3, 0}, {2, 3, 0}}, below), {3, 0});
  ASSERT_TRUE(third.contact);
  EXPECT_EQ(third.first, (TimeEnclosure{1.0 / 3, std::nextafter(1.0 / 3, 1)}));
  // Past the edge below z = 0 and past another edge.
  expect_first({{2, -3, -1}, {2, -3, 1}}, test::resting_face, 3, half);
  expect_first(along_x, {MovingPoint{{0, 3, -1}, {0, 3, 1}}, MovingPoint{{0, 7, -1}, {0, 7, 1}}},
               {3, 0}, half);
}

// f of the face is zero at all times: the conditions begin to hold where the edge is met.
TEST(FeatureDistance, SlidesInAtHeightD) {
  expect_first({{-4, 1, 1}, {4, 1, 1}}, test::resting_face, 1, half);
  expect_first({rest({0, 0, 0}), rest({4, 0, 0})},
               {MovingPoint{{-4, -2, 1}, {4, -2, 1}}, MovingPoint{{-4, 2, 1}, {4, 2, 1}}}, {1, 0},
               half);
}

TEST(FeatureDistance, SquareOfDIsExact) {
  const double d = 1 + 0x1p-52;
  const MovingFace below = {rest({0, 0, 0}), rest({1, 0, -5}), rest({0, 1, -5})};
  const auto at = [&](double x, double y) { return vertex_face(rest({0, -y, x}), below); };
  EXPECT_TRUE(first_time_within(at(d, 0), {d, 0}).contact);
  expect_apart(at(d, 0x1p-60), {d, 0});
  // The sum of two doubles is no double.
  EXPECT_TRUE(first_time_within(at(1, 0x1p-40), {1, 0x1p-60}).contact);
  expect_apart(at(1, 0x1p-40), {1, 0x1p-82});
  EXPECT_TRUE(first_time_within(at(1, 0x1p-40), {1, 0x3p-82}).contact);
  // 2 - 2t = 1 + 2^-60.
  const ContactAnswer falling =
      first_time_within(vertex_face({{0, 0, 2}, {0, 0, 0}}, below), {1, 0x1p-60});
  EXPECT_EQ(falling.first, about(0.5));
}

TEST(FeatureDistance, CollapsedFeatures) {
  const MovingPoint coming = {{-3, 4, 12}, {3, 4, 12}};  // 13 from the origin at both ends
  const MovingFace point = {rest({0, 0, 0}), rest({0, 0, 0}), rest({0, 0, 0})};
  expect_first(coming, point, 13, {0, 0});
  const ContactAnswer in_between =
      first_time_within(vertex_face({{-9, 4, 3}, {3, 4, 3}}, point), {5, 0});
  EXPECT_EQ(in_between.first, (TimeEnclosure{0.75, 0.75}));
  const MovingFace segment = {rest({-9, 0, 0}), rest({9, 0, 0}), rest({0, 0, 0})};
  expect_first({{0, 0, 8}, {0, 0, 0}}, segment, 4, half);
  EXPECT_EQ(
      first_time_within(
          {{rest({1, 0, 8}), rest({1, 0, 8}), {{0, 0, 0}, {0, 0, 8}}, {{2, 0, 0}, {2, 0, 8}}}, 2},
          {4, 0})
          .first,
      half);
}

TEST(FeatureDistance, LeastDistanceByHand) {
  EXPECT_EQ(least_distance(vertex_face({{1, 1, 3}, {1, 1, -1}}, test::resting_face)), 0);
  EXPECT_EQ(least_distance(vertex_face({{1, 1, 3}, {1, 1, 0.1}}, test::resting_face)), 0.1);
  EXPECT_EQ(least_distance(vertex_face({{-1, -3, 0}, {3, -3, 0}}, test::resting_face)), 3);
  // The distance is sqrt 2, which the nearest double is above; sqrt 3 is above its nearest double.
  EXPECT_EQ(least_distance(vertex_face(rest({-1, -1, 0}), test::resting_face)), std::sqrt(2.0));
  EXPECT_EQ(least_distance(vertex_face(rest({-1, -1, 1}), test::resting_face)),
            std::nextafter(std::sqrt(3.0), 2));
  // Closest at 2/3, in between all doubles: p = (3t - 2, ...) passes the vertex 0 at 5.
  const MovingFace below = {rest({0, 0, 0}), rest({1, -5, 0}), rest({-1, -5, 0})};
  EXPECT_EQ(least_distance(vertex_face({{-2, 3, 4}, {1, 3, 4}}, below)), 5);
}

TEST(FeatureDistance, DenormalsAndGreatestDoubles) {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  constexpr double most = std::numeric_limits<double>::max();
  const auto falling = [](double from, double to) {
    return vertex_face({{0, 0, from}, {0, 0, to}},
                       {rest({-1, -1, 0}), rest({2, -1, 0}), rest({-1, 2, 0})});
  };
  EXPECT_EQ(first_time_within(falling(3 * least, -least), {least, 0}).first, half);
  expect_apart(falling(3 * least, 2 * least), {least, 0});
  EXPECT_TRUE(first_time_within(falling(3 * least, 2 * least), {least, least}).contact);
  EXPECT_EQ(least_distance(falling(3 * least, 2 * least)), 2 * least);
  EXPECT_EQ(first_time_within(falling(most, 0), {most / 2, 0}).first, half);
  EXPECT_EQ(first_time_within(falling(most, -most), {0, least}).first, about(0.5));
  EXPECT_EQ(least_distance(falling(most, most / 2)), most / 2);
  EXPECT_EQ(first_time_within(falling(least, most), {least, 0}).first, (TimeEnclosure{0, 0}));
  EXPECT_EQ(first_time_within(falling(most, most), {most, least}).first, (TimeEnclosure{0, 0}));
  const FourPoints farther_than_doubles = vertex_face(
      rest({most, 0, 0}), {rest({-most, 0, 0}), rest({-most, 1, 0}), rest({-most, 0, 1})});
  EXPECT_EQ(least_distance(farther_than_doubles), infinity);
  EXPECT_TRUE(first_time_within(farther_than_doubles, {most, most}).contact);
}

// Which rung decides.
TEST(FeatureDistance, Rungs) {
  const auto rung = [](const MovingPoint& p, double d) {
    return first_time_within(vertex_face(p, test::resting_face), {d, 0}).rung;
  };
  EXPECT_EQ(rung({{1, 1, 3}, {1, 1, 2}}, 1), Rung::axis);
  EXPECT_EQ(rung({{5, 5, 0}, {5, 5, 0}}, 0.5), Rung::axis);
  EXPECT_EQ(rung({{5, 1, 0}, {5, 1, 0}}, 1), Rung::interval);
  EXPECT_EQ(rung({{3, 3, 0}, {3, 4, 0}}, 1), Rung::interval);  // beside the long edge
  EXPECT_EQ(rung({{1, 1, 3}, {1, 1, 2}}, 3.5), Rung::interval);
  EXPECT_EQ(rung({{1, 1, 3}, {1, 1, 0.1}}, 1), Rung::interval);
  EXPECT_EQ(rung({{2, -3, -1}, {2, -3, 2}}, 3), Rung::quadratic);  // passes at exactly d
  EXPECT_EQ(rung({{1, 1, 0x1p251}, {1, 1, 0}}, 1), Rung::quadratic);
}

// Zeros of regions with the conditions at them: for polynomials whose zeros are known, and against
// CGAL's algebraic kernel.

IntegerPolynomial product_of(const std::vector<IntegerPolynomial>& factors) {
  IntegerPolynomial p{{1}};
  for (const IntegerPolynomial& f : factors) p = p * f;
  return p;
}

const IntegerPolynomial third{{-1, 3}}, two_thirds{{-2, 3}}, root_of_half{{-1, 0, 2}};

TEST(CommonDivisor, OfKnownZeros) {
  const IntegerPolynomial imaginary{{1, 0, 1}};
  const IntegerPolynomial p = product_of({third, third, two_thirds, imaginary});
  const auto expect = [](const IntegerPolynomial& found, const IntegerPolynomial& expected) {
    EXPECT_TRUE(found.c == expected.c || found.c == (-expected).c);
  };
  expect(common_divisor(p, derivative(p)), third);
  expect(common_divisor(derivative(p), p), third);
  expect(common_divisor(p, product_of({root_of_half, two_thirds, imaginary})),
         two_thirds * imaginary);
  expect(common_divisor(p, root_of_half), {{1}});
  expect(common_divisor(p, {{7}}), {{1}});
  expect(common_divisor(p, p), p);
  expect(quotient(p, third), product_of({third, two_thirds, imaginary}));
  // The first prime that is tried divides leading coefficients, or a resultant: no matter.
  const Integer prime = (Integer(1) << 30) + 3;
  const IntegerPolynomial of_prime{{-1, prime}}, near_third{{Integer(-1 - prime), 3}};
  expect(common_divisor(p * of_prime, of_prime * root_of_half), of_prime);
  expect(common_divisor(p * of_prime, root_of_half), {{1}});
  expect(common_divisor(third, near_third), {{1}});
}

// More primes are needed than one, and coefficients are negative, too.
TEST(CommonDivisor, OfLongCoefficients) {
  const Integer big = (Integer(1) << 5000) + 7;
  const IntegerPolynomial common{{-big, Integer(3 * big + 1), Integer(-5 * big)}};
  const IntegerPolynomial found =
      common_divisor(common * third * IntegerPolynomial{{big}}, common * common * root_of_half);
  EXPECT_TRUE(found.c == common.c || found.c == (-common).c);
  EXPECT_EQ(quotient(common * third, common).c, third.c);
}

TEST(CommonDivisor, PiecesOfAPolynomial) {
  EXPECT_EQ(on_piece(third, 0.25, 0.5).c, (std::vector<Integer>{-1, 3}));  // 3/4 + 3/4 x - 1
  EXPECT_EQ(on_piece(third, 0.5, 0.25).c, (std::vector<Integer>{2, -3}));
  EXPECT_EQ(on_piece(root_of_half, 0, 0.5).c, (std::vector<Integer>{-2, 0, 1}));
}

const Integer two_to_200 = Integer(1) << 200;
// Its zero is above 1/3 by less than doubles can tell: both have one enclosure.
const IntegerPolynomial beside{{Integer(-3 * two_to_200 - 1), Integer(9 * two_to_200)}};
const std::optional<TimeEnclosure> of_both_times =
    TimeEnclosure{1.0 / 3, std::nextafter(1.0 / 3, 1)};

// Both zeros, 1/3 and that beside it, are between the same two doubles.
TEST(RegionTimes, ClustersBetweenDoubles) {
  const IntegerPolynomial both = third * beside;
  // Between the zeros, at 1/3 + 1/(18 2^200), this changes its sign.
  const IntegerPolynomial between{{Integer(-6 * two_to_200 - 1), Integer(18 * two_to_200)}};
  EXPECT_EQ(first_zero({both, {between}}, 0, 1), of_both_times);
  EXPECT_EQ(first_zero({both, {-between}}, 0, 1), of_both_times);
  EXPECT_EQ(first_zero({both, {between, third}, {{1}}}, 0, 1), of_both_times);
  EXPECT_FALSE(first_zero({both, {between, -third}}, 0, 1));
  EXPECT_FALSE(first_zero({both, {between, -between}}, 0, 1));
  EXPECT_FALSE(first_zero({both, {-between}, third * third}, 0, 1));
  EXPECT_EQ(first_zero({both * both * two_thirds, {-between}}, 0, 1), of_both_times);
}

// Conditions at one zero: shared with it, of it alone, and next to it in 200 bits.
TEST(RegionTimes, ConditionsAtAZero) {
  EXPECT_EQ(first_zero({third, {third, -third, two_thirds * third}}, 0, 1), of_both_times);
  EXPECT_FALSE(first_zero({third, {two_thirds}}, 0, 1));
  EXPECT_EQ(first_zero({third, {-beside}}, 0, 1), of_both_times);
  EXPECT_FALSE(first_zero({third, {beside}}, 0, 1));
  EXPECT_EQ(first_zero({third, {}, beside * beside}, 0, 1), of_both_times);
  EXPECT_FALSE(first_zero({third, {}, third * third}, 0, 1));
  EXPECT_EQ(first_zero({third * third, {-beside * third * third}}, 0, 1), of_both_times);
  // The second zero, at which alone the conditions hold, and one at an end.
  EXPECT_EQ(first_zero({third * root_of_half, {{{-1, 2}}}}, 0, 1)->hi, std::sqrt(0.5));
  EXPECT_EQ(first_zero({IntegerPolynomial{{1, -1}} * third, {{{-1, 2}}}}, 0, 1),
            std::optional(TimeEnclosure{1, 1}));
  EXPECT_FALSE(first_zero({IntegerPolynomial{{0, 1}}, {}}, 0, 1));  // s itself is not asked for
}

// Zeros below the least double and above the double before 1, told apart by their exponents.
TEST(RegionTimes, ClustersAtTheEndsOfTheStep) {
  const auto near_zero = [](unsigned bits) { return IntegerPolynomial{{-1, Integer(1) << bits}}; };
  const auto near_one = [](unsigned bits) {
    return IntegerPolynomial{{Integer(1 - (Integer(1) << bits)), Integer(1) << bits}};
  };
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(first_zero({near_zero(9000) * near_zero(3000), {-near_zero(8000)}}, 0, 1),
            std::optional(TimeEnclosure{0, least}));
  EXPECT_FALSE(first_zero({near_zero(9000) * near_zero(3000), {-near_zero(9999)}}, 0, 1));
  EXPECT_EQ(first_zero({near_one(9000) * near_one(3000), {near_one(8000)}}, 0, 1),
            std::optional(TimeEnclosure{std::nextafter(1.0, 0), 1}));
  EXPECT_FALSE(first_zero({near_one(9000) * near_one(3000), {near_one(9999)}}, 0, 1));
}

std::optional<TimeEnclosure> first_zero_by_kernel(const Region& region) {
  if (region.f.is_zero()) return {};
  const AlgebraicTimes times({&region.f, 1});
  for (int i = 0; i < times.size(); ++i) {
    bool hold = times.sign(region.positive, i) > 0;
    for (const IntegerPolynomial& g : region.not_negative) hold = hold && times.sign(g, i) >= 0;
    if (hold) return times.enclosure(i);
  }
  return {};
}

TEST(RegionTimes, AgreeWithTheAlgebraicKernel) {
  test::Random random(16);
  int zeros = 0, even = 0;
  test::for_each_kind(random, 40, [&](const FourPoints& q) {
    constexpr double distances[] = {0, 0.5, 1, 2, 3};
    const Separation d = {distances[random.below(5)], random.below(3) == 0 ? 0x1p-70 : 0};
    const Regions regions(q, d);
    for (int r = 0; r < regions.size(); ++r) {
      const Region region = regions[r];
      const auto expected = first_zero_by_kernel(region);
      const auto found = first_zero(region, 0, 1);
      // The kernel's first zero may be 0, which first_zero leaves out.
      if (expected && expected->hi == 0) continue;
      ASSERT_EQ(found, expected) << r;
      zeros += expected.has_value();
      even += expected && sign_at(derivative(region.f), expected->lo) == 0;
    }
  });
  EXPECT_GT(zeros, 300);
  EXPECT_GT(even, 10);
}

}  // namespace
}  // namespace assay::oracle
