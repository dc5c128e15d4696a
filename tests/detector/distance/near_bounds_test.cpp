// The bounds of near_filter.h hold: what it computes in doubles, against the same in exact binary
// fractions. Prints the largest error beside what is allowed.
#include "detector/distance/near_filter.h"
#include "tests/detector/distance/rational_distance.h"
#include "tests/detector/exact/exact_numbers.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

using tests::Rational;

constexpr int cases = 2000;

// The four points of a query seen from the first, at a time.
struct Seen {
  SeenPoints computed;
  std::array<tests::RationalPoint, 3> exact;
  double magnitude = 0;

  Seen(const FourPoints& q, double time) {
    Vector m = {0, 0, 0};
    const tests::RationalPoint from = tests::place_at(q.points[0], Rational(time));
    for (std::size_t j = 0; j < 3; ++j) {
      const MovingVector x = difference(q.points[j + 1], q.points[0]);
      grow(m, x);
      for (std::size_t k = 0; k < 3; ++k) computed[j][k] = (1 - time) * x.t0[k] + time * x.t1[k];
      exact[j] = tests::minus(tests::place_at(q.points[j + 1], Rational(time)), from);
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
    const Rational length = tests::squared(n[0]) + tests::squared(n[1]) + tests::squared(n[2]);
    const double size = std::sqrt(static_cast<double>(length));
    if (!(size > 0)) continue;
    // distance - size = (distance^2 - size^2) / (distance + size)
    const Rational exact = tests::squared_distance(q, Rational(time));
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
  int decided = 0, near = 0, open = 0;
  for (int i = 0; i < cases; ++i) {
    const FourPoints q = next(i);
    const Rational exact = tests::squared_distance(q, Rational(i % 2));
    const double off = std::ldexp(1, -(i % 53));
    const double d = std::sqrt(static_cast<double>(exact)) * (i / 2 % 2 == 0 ? 1 - off : 1 + off);
    const NearResult result = filter_near(q, d);
    open += result.decision == Decision::open;
    if (result.decision == Decision::open) continue;
    ++decided;
    const Rational within = tests::squared(d);
    if (result.decision == Decision::no) {
      for (int s = 0; s <= 8; ++s)
        ASSERT_GT(tests::squared_distance(q, Rational(s, 8)), within) << "case " << i;
    } else {
      ++near;
      ASSERT_LE(tests::squared_distance(q, Rational(result.hi)), within) << "case " << i;
      if (result.hi > 0) {
        ASSERT_GT(tests::squared_distance(q, Rational(result.lo)), within) << "case " << i;
      }
    }
  }
  std::printf("%d decided, %d of them near; %d open\n", decided, near, open);
  EXPECT_GT(near, cases / 8);
  EXPECT_GT(decided - near, cases / 32);
}

}  // namespace
}  // namespace assay::detector
