// The widening of 2^-52 |r| and the least double: exact results lie inside, for ordinary numbers
// and for denormals.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include "oracle/query/interval_sign.h"
#include "tests/oracle/random_points.h"

namespace assay::oracle {
namespace {

TEST(Enclosure, HoldsExactResults) {
  test::Random random(168);
  constexpr int rounds = 20000;
  for (int i = 0; i < rounds; ++i) {
    const int spread = i % 3 == 0 ? 1 : 60, centre = i % 2 == 0 ? 0 : -535;
    const auto number = [&] { return std::ldexp(random.unit(), centre + random.below(spread)); };
    const double a = number(), b = number();
    const auto expect = [&](const Enclosure& found, const mpq_class& exact) {
      ASSERT_LE(mpq_class(found.lo), exact) << a << " " << b;
      ASSERT_GE(mpq_class(found.hi), exact) << a << " " << b;
    };
    const mpq_class x(a), y(b);
    expect(Enclosure(a) + Enclosure(b), x + y);
    expect(Enclosure(a) - Enclosure(b), x - y);
    expect(a * Enclosure(b), x * y);
    expect(square(Enclosure(a)), x * x);
    const Enclosure apart = Enclosure(a) - Enclosure(b);
    expect(square(apart), (x - y) * (x - y));
    expect(b * (apart + Enclosure(b)), y * x);
    EXPECT_GT(apart.hi, apart.lo);
  }
}

}  // namespace
}  // namespace assay::oracle
