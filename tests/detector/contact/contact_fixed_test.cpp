// Integers of fixed width compared with the general path: verdicts, times in every bit, and how
// many queries they leave open; numbers at the bounds of the widths; signs at roots compared with
// Tarski queries.
#include "detector/contact/fixed_products.h"
#include "detector/contact/fixed_root.h"
#include "detector/contact/rungs.h"
#include "detector/exact/real_root.h"
#include "tests/detector/contact/query_draw.h"
#include "tests/detector/exact/tarski.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

struct Tally {
  int contacts = 0, open = 0;
};

void compare(const FourPoints& query, Tally& tally) {
  const FixedResult fixed = fixed_contact(query, Want::first_time);
  const FixedResult yes_no = fixed_contact(query, Want::yes_no);
  const auto general = general_first_contact(query);
  // Of several times in one plane the first may stay open where one of them is known.
  ASSERT_TRUE(yes_no.decision == Decision::open ||
              (yes_no.decision == Decision::yes) == general.has_value());
  if (fixed.decision == Decision::open) {
    ++tally.open;
    return;
  }
  ASSERT_EQ(fixed.decision, yes_no.decision);
  ASSERT_EQ(fixed.decision == Decision::yes, general.has_value());
  if (!general) return;
  ++tally.contacts;
  ASSERT_EQ(fixed.time, *general);
}

void expect_agreement(const char* queries_named, int queries, int most_open, const auto& next) {
  Tally tally;
  for (int i = 0; i < queries; ++i)
    ASSERT_NO_FATAL_FAILURE(compare(next(), tally)) << queries_named << ", query " << i;
  EXPECT_GT(tally.contacts, queries / 50) << queries_named;
  EXPECT_LE(tally.open, most_open) << queries_named;
}

TEST(ContactFixed, AgreesWithTheGeneralPath) {
  tests::QueryDraw draw(31);
  expect_agreement("small integers", 20000, 200,
                   [&] { return draw.query([&] { return draw.between(-2, 2); }); });
  expect_agreement("integers", 10000, 30,
                   [&] { return draw.query([&] { return draw.between(-9, 9); }); });
  expect_agreement("full doubles", 10000, 10,
                   [&] { return draw.query([&] { return draw.full(); }); });
  expect_agreement("two limbs", 5000, 500, [&] {
    return draw.query([&] { return std::ldexp(draw.full(), draw.between(-40, 0)); });
  });
  expect_agreement("five limbs", 2000, 1000, [&] {
    return draw.query([&] { return std::ldexp(draw.full(), draw.between(-100, 100)); });
  });
}

// Edges that mirror each other in the plane z = 0 meet end to end, or cross where they are: common
// roots of the cubic and of the dependencies.
TEST(ContactFixed, SettlesMirrorImages) {
  tests::QueryDraw draw(31);
  const auto mirrored = [](MovingPoint p) {
    p.t0[2] = -p.t0[2];
    p.t1[2] = -p.t1[2];
    return p;
  };
  const auto moving = [&] {
    return MovingPoint{{draw.full(), draw.full(), std::abs(draw.full())},
                       {draw.full(), draw.full(), -std::abs(draw.full())}};
  };
  expect_agreement("mirrored edges", 5000, 500, [&] {
    const MovingPoint a = moving(), b = moving();
    return FourPoints{{a, b, mirrored(a), mirrored(b)}, 2};
  });
  expect_agreement("edges that share an image", 5000, 500, [&] {
    const MovingPoint a = moving(), b = moving(), c = moving();
    return FourPoints{{a, b, mirrored(a), mirrored(c)}, 2};
  });
  expect_agreement("in one plane", 5000, 500, [&] {
    auto query = draw.query([&] { return draw.full(); });
    for (auto& p : query.points) p.t0[1] = p.t1[1] = 0;
    return query;
  });
}

// Points of one line, throughout or at an instant, are settled: the time is that at which
// differences along an axis say so.
TEST(ContactFixed, SettlesPointsOfOneLine) {
  tests::QueryDraw draw(31);
  const auto integer = [&] { return static_cast<double>(draw.between(-9, 9)); };
  expect_agreement("on one line throughout", 10000, 0, [&] {
    const Point way = {integer(), integer(), integer()};
    auto query = draw.query([] { return 0.; });
    for (auto& p : query.points) {
      const double from = integer(), to = integer();
      for (std::size_t k = 0; k < 3; ++k) {
        p.t0[k] = from * way[k];
        p.t1[k] = to * way[k] + 3;
      }
    }
    return query;
  });
  expect_agreement("through one point at once", 5000, 0, [&] {
    auto query = draw.query([&] { return draw.full(); });
    for (auto& p : query.points) {
      for (std::size_t k = 0; k < 3; ++k) p.t1[k] = -p.t0[k];
    }
    return query;
  });
  expect_agreement("upright edges that turn over, in one plane", 5000, 200, [&] {
    const auto upright = [](double x0, double x1, double z0, double z1) {
      return MovingPoint{{x0, 0, z0}, {x1, 0, z1}};
    };
    const double a0 = draw.full(), a1 = draw.full(), b0 = draw.full(), b1 = draw.full();
    const double low = draw.full(), high = draw.full(), speed = draw.full();
    return FourPoints{{upright(a0, a1, low, high), upright(b0, b1, low, high),
                       upright(a0, a1, high, speed), upright(b0, b1, high, speed)},
                      2};
  });
}

// The largest coordinates that a width admits, in all signs: nothing wraps.
TEST(ContactFixed, WidthsHoldTheirBounds) {
  tests::QueryDraw draw(31);
  for (const int bits : {most_bits<1>, most_bits<2>, most_bits<3>, most_bits<5>}) {
    const double most = std::ldexp(1 - 0x1p-53, bits), unit = 1;
    const FourPoints scale = {{MovingPoint{{most, most, most}, {unit, unit, unit}}, {}, {}, {}}, 1};
    ASSERT_EQ(QueryIntegers(scale).bits(), bits);
    expect_agreement("extremes", 3000, 600, [&] {
      return draw.query([&]() -> double {
        const int sign = draw.between(0, 1) ? 1 : -1;
        return sign * (draw.between(0, 7) ? most : unit);
      });
    });
  }
}

// The part of a double below the root of a cubic that is asked for where times are near 0.
TEST(ContactFixed, FindsTimesNearZero) {
  for (const double height : {0x1p-90, 0x1p-140, 0x1p-250}) {
    const FourPoints query = {{MovingPoint{{.25, .25, height}, {.25, .25, -.75}},
                               {{0, 0, 0}, {0, 0, 0}},
                               {{1, 0, 0}, {1, 0, 0}},
                               {{0, 1, 0}, {0, 1, 0}}},
                              1};
    const FixedResult fixed = fixed_contact(query, Want::first_time);
    ASSERT_EQ(fixed.decision, Decision::yes) << height;
    EXPECT_EQ(fixed.time, *general_first_contact(query)) << height;
    EXPECT_EQ(*fixed_bracketed_time(query, 0, 1, .5), fixed.time) << height;
  }
}

TEST(ContactFixed, SignAtRootIsThatOfATarskiQuery) {
  using Triple = FixedInteger<3>;
  using Minor = FixedInteger<2>;
  tests::QueryDraw draw(31);
  const Polynomial t = Polynomial::linear(0, 1), s = Polynomial::linear(1, 0);
  int compared = 0, zeros = 0;
  for (int i = 0; i < 60000; ++i) {
    const int reach = i % 2 ? 3 : 1000;
    // Times a common linear factor in every fourth case: common roots that are no small fractions.
    std::array<std::int64_t, 4> f;
    std::array<std::int64_t, 3> l;
    if (i % 4 == 0) {
      const int p = draw.between(1, 30), q = -draw.between(1, 30);
      const int a = draw.between(1, 9), b = draw.between(1, 9), c = draw.between(-9, 9);
      const int d = draw.between(1, 9), e = draw.between(-9, 9);
      f = {3 * p * a, 2 * p * b + q * a, p * c + 2 * q * b, 3 * q * c};
      l = {2 * p * d, p * e + q * d, 2 * q * e};
    } else {
      for (auto& c : f) c = draw.between(-reach, reach);
      for (auto& c : l) c = draw.between(-reach, reach);
    }
    const FixedCubic<Triple> fixed_f = {f[0], f[1], f[2], f[3]};
    const FixedQuadratic<Minor> fixed_l = {l[0], l[1], l[2]};
    const PieceSigns f_signs = piece_signs(fixed_f), l_signs = piece_signs(fixed_l);
    if (f_signs.changes != 1 || l_signs.changes != 1) continue;
    const auto of = [](std::int64_t value) { return Polynomial::constant(Integer(value)); };
    const Polynomial cubic = of(f[0]) * s * s * s + of(3 * f[1]) * t * s * s +
                             of(3 * f[2]) * t * t * s + of(f[3]) * t * t * t;
    const Polynomial quadratic = of(l[0]) * s * s + of(2 * l[1]) * t * s + of(l[2]) * t * t;
    std::optional<int> expected;
    for (const auto& root : roots_in_unit_interval(cubic)) {
      if (root.sign_of(t) > 0 && root.sign_of(s) > 0) expected = root.sign_of(quadratic);
    }
    ASSERT_TRUE(expected) << i;
    ASSERT_TRUE(f.front() == 0 || f.back() == 0 ||
                tests::tarski_query(cubic, quadratic, Dyadic::of(0), Dyadic::of(1)) == *expected)
        << i;
    const SignAtRoot<1> sign(fixed_f, f_signs.first, 40);
    ASSERT_EQ(sign.of(fixed_l, l_signs.first), *expected) << i;
    ++compared;
    zeros += *expected == 0 ? 1 : 0;
  }
  EXPECT_GT(compared, 5000);
  EXPECT_GT(zeros, 500);
}

}  // namespace
}  // namespace assay::detector
