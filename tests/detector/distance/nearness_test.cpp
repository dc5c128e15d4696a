// When two features come within d (L16): each region in a case made by hand, and random steps
// compared with distances in rational numbers.
#include "detector/distance/nearness.h"

#include "tests/asked.h"
#include "tests/detector/distance/rational_distance.h"
#include "tests/detector/exact/exact_numbers.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::place_at, tests::Rational, tests::squared, tests::squared_distance, tests::still;

constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

FourPoints vertex_face(MovingPoint p, MovingPoint a, MovingPoint b, MovingPoint c) {
  return {{p, a, b, c}, 1};
}
FourPoints edge_edge(MovingPoint a, MovingPoint b, MovingPoint c, MovingPoint e) {
  return {{a, b, c, e}, 2};
}

// The ladder and its last rung by itself.
void expect_near(const FourPoints& q, double d, TimeEnclosure time) {
  const ContactResult result = test_near(q, d, Want::first_time);
  ASSERT_TRUE(result.contact);
  EXPECT_EQ(result.time, time) << result.time.lo << ' ' << time.lo;
  EXPECT_EQ(exact_near_time(q, d), time);
  EXPECT_TRUE(test_near(q, d, Want::yes_no).contact);
}
void expect_near(const FourPoints& q, double d, double time) { expect_near(q, d, {time, time}); }
void expect_apart(const FourPoints& q, double d) {
  EXPECT_FALSE(test_near(q, d, Want::first_time).contact);
  EXPECT_FALSE(test_near(q, d, Want::yes_no).contact);
  EXPECT_FALSE(exact_near_time(q, d));
}

const MovingPoint a = still({0, 0, 0}), b = still({8, 0, 0}), c = still({0, 8, 0});

// A vertex that falls from (x, y, 9) to (x, y, 1), 8 in a step.
MovingPoint falling(double x, double y) { return {{x, y, 9}, {x, y, 1}}; }

TEST(Near, L16_RegionsOfVertexAndFace) {
  expect_near(vertex_face(falling(2, 2), a, b, c), 5, 0.5);     // the face
  expect_near(vertex_face(falling(4, -3), a, b, c), 5, 0.625);  // an edge: 4 above, 3 beside
  expect_near(vertex_face(falling(-3, 4), a, b, c), 5, 0.625);
  expect_near(vertex_face(falling(7, 7), a, b, c), 4.5, 0.9375);  // 1.5 above, sqrt(18) beside
  expect_near(vertex_face(falling(-2, -2), a, b, c), 3, 1.0);     // a point: 1 above, sqrt(8)
  expect_apart(vertex_face(falling(2, 2), a, b, c), std::nextafter(1, 0));
  expect_near(vertex_face(falling(2, 2), a, b, c), 1, 1.0);
  expect_near(vertex_face(falling(2, 2), a, b, c), 9, 0.0);
}

TEST(Near, L16_RegionsOfTwoEdges) {
  const auto over = [](double x0, double y0, double x1, double y1) {
    return std::pair<MovingPoint, MovingPoint>{falling(x0, y0), falling(x1, y1)};
  };
  const auto query = [&](const auto& edge) { return edge_edge(a, b, edge.first, edge.second); };
  expect_near(query(over(4, -4, 4, 4)), 5, 0.5);      // both feet inside
  expect_near(query(over(4, 3, 4, 9)), 5, 0.625);     // its end, the edge ab
  expect_near(query(over(-3, -5, -3, 4)), 5, 0.625);  // the end a
  expect_near(query(over(-3, 0, -9, 1)), 5, 0.625);   // two ends
  expect_near(query(over(2, 3, 6, 3)), 5, 0.625);     // parallel, side by side
  expect_near(query(over(11, 0, 20, 0)), 5, 0.625);   // on parallel lines, beyond the end
  expect_apart(query(over(4, 3, 4, 9)), 3);
}

// A foot on the line of an edge, but not in the edge, does not count.
TEST(Near, L16_FeetHaveToBeInside) {
  const MovingPoint beside = {{20, 3, 0}, {12, 3, 0}};
  expect_near(vertex_face(beside, a, b, c), 5, 1.0);
  expect_apart(vertex_face(beside, a, b, c), 4.5);
  const MovingPoint p = {{12, -1, 1}, {20, -1, 1}}, q = {{12, 1, 1}, {20, 1, 1}};
  expect_apart(edge_edge(a, b, p, q), 4);
}

// At t = 1/2 the face is a segment, its normal is zero, and so is f of the face.
TEST(Near, L16_WhereAFaceCollapsesItsEdgesTell) {
  const MovingPoint turning = {{0, 8, 0}, {0, -8, 0}};
  expect_apart(vertex_face(still({-3, 0, 4}), a, b, turning), std::nextafter(5, 0));
  expect_near(vertex_face(still({-3, 0, 4}), a, b, turning), 5, 0.0);
  expect_apart(vertex_face(still({4, -6, 5}), a, b, {{0, 8, 0}, {0, -4, 0}}), 5);
  // Edges that are parallel at t = 1/2 and far along their line.
  expect_apart(edge_edge(a, b, still({20, 0, 1}), {{28, 4, 1}, {28, -4, 1}}), 11);
  // A face of one point, a face of no area, an edge of no length.
  expect_near(vertex_face(falling(3, 0), a, a, a), 5, 0.625);
  expect_near(vertex_face(falling(4, 3), a, b, still({4, 0, 0})), 5, 0.625);
  expect_near(edge_edge(a, b, falling(4, 3), falling(4, 3)), 5, 0.625);
  expect_near(edge_edge(a, a, falling(3, 0), falling(3, 0)), 5, 0.625);
}

// The distance falls to exactly d at one instant: f has a zero of even order.
TEST(Near, L16_TouchesOfEvenOrderCount) {
  const MovingPoint by = {{-3, -4, 0}, {3, -4, 0}};
  expect_near(vertex_face(by, a, still({0, 8, 0}), still({-1, 8, 0})), 4, 0.5);
  expect_apart(vertex_face(by, a, still({0, 8, 0}), still({-1, 8, 0})), std::nextafter(4, 0));
  const MovingPoint third = {{-1, -4, 0}, {2, -4, 0}};
  expect_near(vertex_face(third, a, still({0, 8, 0}), still({-1, 8, 0})), 4,
              {1.0 / 3, std::nextafter(1.0 / 3, 1)});
}

TEST(Near, L16_AtRestAtExactlyTheDistance) {
  expect_near(vertex_face(still({2, 2, 5}), a, b, c), 5, 0.0);
  expect_apart(vertex_face(still({2, 2, 5}), a, b, c), std::nextafter(5, 0));
  expect_near(vertex_face(still({-3, -4, 0}), a, b, c), 5, 0.0);
  expect_near(edge_edge(a, b, still({2, 3, 4}), still({6, 3, 4})), 5, 0.0);
  // Moving along at exactly d.
  expect_near(vertex_face({{2, 2, 5}, {20, 2, 5}}, a, b, c), 5, 0.0);
  // Before, the foot is outside.
  expect_near(vertex_face({{22, 2, 5}, {-10, 2, 5}}, a, b, c), 5, 0.5);
}

// d^2 in doubles would be another number.
TEST(Near, L16_TheSquareIsExact) {
  const double d = 1 + 0x1p-52;
  expect_near(vertex_face(still({2, 2, d}), a, b, c), d, 0.0);
  expect_apart(vertex_face(still({2, 2, d}), a, b, c), 1);
  expect_apart(vertex_face(still({2, 2, std::nextafter(d, 2)}), a, b, c), d);
  expect_near(vertex_face(still({-d, 0, 0}), a, b, c), d, 0.0);
}

TEST(Near, L16_DistancesOfAnySize) {
  const FourPoints q = vertex_face(falling(2, 2), a, b, c);
  for (const double d : {1e10, 1e200, largest}) expect_near(q, d, 0.0);
  for (const double d : {1e-10, 1e-200, smallest}) expect_apart(q, d);
  // Through the face: within the smallest distance just before the contact.
  const FourPoints through = vertex_face({{2, 2, 1}, {2, 2, -1}}, a, b, c);
  expect_near(through, smallest, {std::nextafter(0.5, 0), 0.5});
  expect_near(through, 1e-200, {std::nextafter(0.5, 0), 0.5});
  // Coordinates and distance at the ends of the range.
  const double h = largest;
  expect_near(
      vertex_face({{0, 0, h}, {0, 0, -h}}, still({-h, -h, 0}), still({h, -h, 0}), still({0, h, 0})),
      h / 2, 0.25);
  expect_near(vertex_face({{0, 0, 3 * smallest}, {0, 0, smallest}}, a, b, c), 2 * smallest, 0.5);
  expect_apart(vertex_face(still({0, 0, 3 * smallest}), a, b, c), 2 * smallest);
  expect_near(vertex_face({{2, 2, h}, {2, 2, 0}}, a, b, c), smallest, {std::nextafter(1, 0), 1});
}

class NearSteps {
 public:
  explicit NearSteps(std::uint64_t seed) : engine_(seed) {}
  int between(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }

  // Small integers: many degenerate features, a fifth at rest. One in four is off by a last place.
  FourPoints query(bool off) {
    FourPoints q;
    q.first_group = between(1, 2);
    const int reach = between(1, 6);
    for (MovingPoint& p : q.points) {
      for (std::size_t k = 0; k < 3; ++k) p.t0[k] = number(reach, off);
      p.t1 = p.t0;
      if (between(0, 4) == 0) continue;
      for (std::size_t k = 0; k < 3; ++k) p.t1[k] = number(reach, off);
    }
    if (between(0, 4) == 0) q.points[3] = q.points[2];
    return q;
  }

 private:
  double number(int reach, bool off) {
    const double x = between(-reach, reach);
    return off && between(0, 3) == 0 ? std::nextafter(x, between(0, 1) ? 10.0 : -10.0) : x;
  }
  std::mt19937_64 engine_;
};

// Before the first time nothing is within d, at it something is, and where there is none nothing
// is.
void expect_first(const FourPoints& q, double d, const std::optional<TimeEnclosure>& first) {
  const Rational within = squared(d);
  constexpr int samples = 16;
  for (int i = 0; i <= samples; ++i) {
    const Rational t(i, samples);
    if (first && t > Rational(first->lo)) break;
    if (first && first->lo == first->hi && t == Rational(first->lo)) break;
    ASSERT_GT(squared_distance(q, t), within) << "at sample " << i;
  }
  if (!first) return;
  if (first->lo < first->hi) {
    ASSERT_EQ(std::nextafter(first->lo, 2), first->hi);
    EXPECT_GT(squared_distance(q, Rational(first->lo)), within);
  } else if (first->lo > 0) {
    EXPECT_EQ(squared_distance(q, Rational(first->lo)), within);
  }
  EXPECT_LE(squared_distance(q, Rational(first->hi)), within);
}

TEST(Near, L16_RandomStepsAgainstRationalDistances) {
  NearSteps steps(351);
  int near = 0, inside_a_gap = 0, by_integers = 0;
  for (int i = 0; i < tests::usual(1600); ++i) {
    const FourPoints q = steps.query(i % 4 == 1);
    const double d = steps.between(1, 8) / 4.0;
    const ContactResult result = test_near(q, d, Want::first_time);
    const auto first = result.contact ? std::optional(result.time) : std::nullopt;
    ASSERT_EQ(first, exact_near_time(q, d)) << "step " << i;
    ASSERT_EQ(test_near(q, d, Want::yes_no).contact, result.contact);
    ASSERT_NO_FATAL_FAILURE(expect_first(q, d, first)) << "step " << i;
    near += result.contact;
    inside_a_gap += first && first->lo < first->hi;
    by_integers += result.rung == ContactRung::unbounded;
  }
  EXPECT_GT(near, tests::usual(500));
  EXPECT_GT(inside_a_gap, tests::usual(200));
  EXPECT_GT(by_integers, tests::usual(10));
}

// With d = 0 the regions are those of a contact.
TEST(Near, L16_WithinZeroIsAContact) {
  NearSteps steps(352);
  int contacts = 0;
  for (int i = 0; i < tests::usual(3000); ++i) {
    const FourPoints q = steps.query(i % 4 == 1);
    const ContactResult contact = test_contact(q, Want::first_time);
    const auto near = exact_near_time(q, 0);
    ASSERT_EQ(near.has_value(), contact.contact) << "step " << i;
    ASSERT_EQ(near.value_or(contact.time), contact.time) << "step " << i;
    contacts += contact.contact;
  }
  EXPECT_GT(contacts, tests::usual(300));
}

TEST(Near, L16_ScaledByPowersOfTwoNothingChanges) {
  NearSteps steps(353);
  for (int i = 0; i < 300; ++i) {
    const FourPoints q = steps.query(false);
    const double d = steps.between(1, 8) / 4.0;
    const auto first = exact_near_time(q, d);
    for (const int exponent : {-600, -60, 60, 600}) {
      FourPoints scaled = q;
      for (MovingPoint& p : scaled.points) {
        for (auto* x : {&p.t0, &p.t1})
          for (double& coordinate : *x) coordinate = std::ldexp(coordinate, exponent);
      }
      const auto result = test_near(scaled, std::ldexp(d, exponent), Want::first_time);
      ASSERT_EQ(result.contact ? std::optional(result.time) : std::nullopt, first) << "step " << i;
    }
  }
}

// The bounds of the filter hold: what it computes in doubles, against the same in exact binary
// fractions. Prints the largest error beside what is allowed.

constexpr int cases = tests::usual(2000);

// The four points of a query seen from the first, at a time.
struct Seen {
  SeenPoints computed;
  std::array<tests::RationalPoint, 3> exact;
  double magnitude = 0;

  Seen(const FourPoints& q, double time) {
    Vector m = {0, 0, 0};
    const tests::RationalPoint from = place_at(q.points[0], Rational(time));
    for (std::size_t j = 0; j < 3; ++j) {
      const MovingVector x = difference(q.points[j + 1], q.points[0]);
      grow(m, x);
      for (std::size_t k = 0; k < 3; ++k) computed[j][k] = (1 - time) * x.t0[k] + time * x.t1[k];
      exact[j] = tests::minus(place_at(q.points[j + 1], Rational(time)), from);
    }
    magnitude = std::max({m[0], m[1], m[2]});
  }
};

double in_units(const Rational& error, double scale) {
  return scale > 0 ? static_cast<double>(Rational(abs(error) / Rational(scale))) / unit_roundoff
                   : 0;
}

class NearBounds : public testing::Test {
 protected:
  FourPoints next(int i) {
    numbers_.family(i % 3);
    FourPoints q;
    for (auto& p : q.points) p = numbers_.point();
    q.first_group = 1 + i / 3 % 2;
    return q;
  }
  Numbers numbers_;
  std::mt19937_64 engine_{352};
};

// gap_error: the difference of n.x of two points.
TEST_F(NearBounds, GapError) {
  double worst = 0;
  for (int i = 0; i < cases; ++i) {
    const FourPoints q = next(i);
    const Seen at(q, std::uniform_real_distribution<double>(0, 1)(engine_));
    const Vector n = between_nearest(at.computed, q.first_group);
    const double size = std::sqrt(dot(n, n));
    const tests::RationalPoint exact_n = {Rational(n[0]), Rational(n[1]), Rational(n[2])};
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const double gap = dot(n, at.computed[j]) - dot(n, at.computed[k]);
        const Rational exact = tests::dot(exact_n, at.exact[j]) - tests::dot(exact_n, at.exact[k]);
        worst = std::max(worst, in_units(Rational(gap) - exact, size * at.magnitude));
      }
    }
  }
  std::printf("gap: %.2f of %.0f allowed\n", worst, gap_error / unit_roundoff);
  EXPECT_LT(worst, gap_error / unit_roundoff);
  EXPECT_GT(worst, 0.5);
}

// place_error: the vector between two places of the features is as long as their distance at
// least, up to the bound.
TEST_F(NearBounds, PlaceError) {
  double worst = -1;
  for (int i = 0; i < cases; ++i) {
    const FourPoints q = next(i);
    const double time = std::uniform_real_distribution<double>(0, 1)(engine_);
    const Seen at(q, time);
    if (at.magnitude == 0) continue;
    const Vector n = between_nearest(at.computed, q.first_group);
    const Rational length = squared(n[0]) + squared(n[1]) + squared(n[2]);
    const double size = std::sqrt(static_cast<double>(length));
    if (!(size > 0)) continue;
    // distance - size = (distance^2 - size^2) / (distance + size)
    const Rational exact = squared_distance(q, Rational(time));
    const double sum = size + std::sqrt(static_cast<double>(exact));
    const double off = static_cast<double>(Rational(exact - length)) / sum / at.magnitude;
    worst = std::max(worst, off / unit_roundoff);
  }
  std::printf("place: too short by %.2f of %.0f allowed\n", worst, place_error / unit_roundoff);
  EXPECT_LT(worst, place_error / unit_roundoff);
  EXPECT_GT(worst, 0.1);
}

// Decisions of the filter by itself, for d from far off to some last places off the distance at an
// end of the step.
TEST_F(NearBounds, TheFilterIsNeverWrong) {
  int decided = 0, near = 0;
  for (int i = 0; i < cases; ++i) {
    const FourPoints q = next(i);
    const Rational exact = squared_distance(q, Rational(i % 2));
    const double off = std::ldexp(1, -(i % 53));
    const double d = std::sqrt(static_cast<double>(exact)) * (i / 2 % 2 == 0 ? 1 - off : 1 + off);
    const NearResult result = filter_near(q, d);
    if (result.decision == Decision::open) continue;
    ++decided;
    const Rational within = squared(d);
    if (result.decision == Decision::no) {
      for (int s = 0; s <= 8; ++s)
        ASSERT_GT(squared_distance(q, Rational(s, 8)), within) << "case " << i;
    } else {
      ++near;
      ASSERT_LE(squared_distance(q, Rational(result.hi)), within) << "case " << i;
      ASSERT_TRUE(result.hi == 0 || squared_distance(q, Rational(result.lo)) > within)
          << "case " << i;
    }
  }
  EXPECT_GT(near, cases / 8);
  EXPECT_GT(decided - near, cases / 32);
}

}  // namespace
}  // namespace assay::detector
