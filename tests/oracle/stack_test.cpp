// Each rung of the oracle runs in a thread with a small stack, on the numbers that need most stack.
// Threads of some systems have half a megabyte, and no depth of calls may depend on how many bits
// two times have in common.
#include "oracle/query/contact.h"
#include "oracle/referee/referee.h"
#include "oracle/view/view_sign.h"
#include "tests/detector/small_stack.h"
#include "tests/oracle/random_points.h"

namespace assay::oracle {
namespace {

using detector::MovingPoint, detector::ViewSign, detector::Want;

using FourMoving = std::array<MovingPoint, 4>;

// A point and a face, all in one plane, with zeros at 1 - e/a and 1 - e/c, both next to 1, and told
// apart by as many bits as a / e has.
FourMoving zeros_next_to_one(double a, double c, double e) {
  return {MovingPoint{{0, -a, 0}, {0, 0, -e}}, MovingPoint{}, MovingPoint{{0, 0, -c}, {0, 0, 0}},
          MovingPoint{{0, 0, 0}, {0, -e, 0}}};
}

FourMoving any_exponents(test::Random& random, bool flat) {
  FourMoving points;
  for (MovingPoint& p : points) {
    for (double* end : {p.t0.data(), p.t1.data()}) {
      for (int k = flat ? 1 : 0; k < 3; ++k)
        end[k] = std::ldexp(random.below(5) - 2, random.below(2097) - 1074);
    }
  }
  return points;
}

void expect_answered(const FourMoving& p) {
  for (const int first_group : {1, 2}) {
    const detector::FourPoints query = {p, first_group};
    const auto first = first_time_by_kernel(query);
    const ContactAnswer answer = contact_of(query, Want::first_time);
    ASSERT_EQ(first.has_value(), answer.contact);
    EXPECT_EQ(first.value_or(answer.first), answer.first);
    (void)referee(query, {20, 20});
  }
}

TEST(OracleStack, ZerosThatManyBitsTellApart) {
  tests::expect_enough_stack("zeros next to 1", [] {
    expect_answered(zeros_next_to_one(0x1p20, 0x1p25, 0x1p-20));
    expect_answered(zeros_next_to_one(0x1p1020, 0x5p510, 0x1p-1070));
    expect_answered(zeros_next_to_one(0x1p795, 0x1p984, 0x1p-742));
  });
}

TEST(OracleStack, ExponentsOverAllDoubles) {
  tests::expect_enough_stack("exponents over all doubles", [] {
    test::Random random(20119);
    for (int i = 0; i < 8; ++i) expect_answered(any_exponents(random, i % 3 == 0));
  });
}

// An end of the line comes from far away.
TEST(OracleStack, ViewLineWhoseEndComesFromFarAway) {
  tests::expect_enough_stack("end from far away", [] {
    const double least = 0x1p-1068;
    const MovingTriangle triangle = {MovingPoint{{0, 0, 0}, {1, 0, 0}},
                                     MovingPoint{{0, 1, 0}, {0, 0, -least}},
                                     MovingPoint{{0, 0, 1}, {0, 0, 0}}};
    for (const int big : {0, 400, 934, 1020}) {
      const detector::ViewPrimitive line = {{{0, 0, std::ldexp(1, big)}, {-least, 0, -least}},
                                            {{1, 0, 0}, {0, 1, 0}}};
      EXPECT_EQ(exact_view_sign(triangle, line), ViewSign::zero) << big;
      EXPECT_EQ(view_sign(triangle, line), ViewSign::zero) << big;
    }
    test::Random random(20120);
    for (int i = 0; i < 20; ++i) {
      const FourMoving p = any_exponents(random, false), q = any_exponents(random, false);
      (void)exact_view_sign({p[0], p[1], p[2]}, {q[0], i % 4 == 0 ? q[0] : q[1]});
    }
  });
}

}  // namespace
}  // namespace assay::oracle
