// The elementary test in a thread with a small stack, over the queries that need most of it.
#include "detector/contact/contact_exact.h"
#include "detector/contact/elementary.h"
#include "detector/geometry/orientation.h"
#include "tests/detector/points.h"
#include "tests/detector/small_stack.h"

namespace assay::detector {
namespace {

// p = (0,-a,0) -> (0,0,-e), face (0,0,0), (0,0,-c) -> 0, 0 -> (0,-e,0): all in one plane, with
// roots at 1 - e/a and 1 - e/c, both next to 1, and told apart by as many bits as a / e has.
FourPoints roots_next_to_one(double a, double c, double e) {
  return four_points(
      VertexFace{{{0, -a, 0}, {0, 0, -e}},
                 {tests::still({0, 0, 0}), {{0, 0, -c}, {0, 0, 0}}, {{0, 0, 0}, {0, -e, 0}}}});
}

// The same as two edges.
FourPoints edges_next_to_one(double a, double c, double e) {
  FourPoints q = roots_next_to_one(a, c, e);
  q.first_group = 2;
  return q;
}

void expect_answered(const FourPoints& query) {
  const auto exact = exact_contact(query);
  const auto general = general_first_contact(query);
  EXPECT_EQ(general.has_value(), exact.contact);
  if (general) {
    EXPECT_EQ(*general, exact.time);
  }
  const ContactResult tested = test_contact(query, Want::first_time);
  EXPECT_EQ(tested.contact, exact.contact);
  if (exact.contact) {
    EXPECT_EQ(tested.time, exact.time);
  }
  test_contact(query, Want::yes_no);
  for (const auto arithmetic :
       {Arithmetic::bounded, Arithmetic::double_precision, Arithmetic::single_precision}) {
    test_contact(query, Want::first_time, arithmetic);
  }
}

TEST(ContactStack, RootsThatManyBitsTellApart) {
  tests::expect_enough_stack("roots next to 1", [] {
    for (int big = 20; big <= 1020; big += 100) {
      for (int small = -20; small >= -1070; small -= 150) {
        const double a = std::ldexp(1, big), c = std::ldexp(5, big / 2), e = std::ldexp(1, small);
        expect_answered(roots_next_to_one(a, c, e));
        expect_answered(edges_next_to_one(a, c, e));
      }
    }
  });
}

TEST(ContactStack, ExponentsOverAllDoubles) {
  tests::expect_enough_stack("exponents over all doubles", [] {
    std::mt19937_64 engine(20117);
    const auto below = [&engine](int n) { return static_cast<int>(engine() % std::uint64_t(n)); };
    for (int i = 0; i < 600; ++i) {
      FourPoints q;
      q.first_group = 1 + i % 2;
      const bool flat = i % 3 == 0;
      for (auto& p : q.points) {
        for (double* end : {p.t0.data(), p.t1.data()}) {
          for (int k = 0; k < 3; ++k) {
            end[k] = flat && k == 0 ? 0 : std::ldexp(below(5) - 2, below(2097) - 1074);
          }
        }
      }
      expect_answered(q);
    }
  });
}

}  // namespace
}  // namespace assay::detector
