// Laws of distance on random queries, most of them degenerate: with d = 0 the answers are those of
// query/contact.h; at exact rational times the squared distance agrees; turned and mirrored queries
// have the same answer; the least distance is the least d for which the answer is yes.
// ASSAY_CASES=100000 runs more queries of each kind, and more queries with exponents over all
// doubles.
#include "oracle/distance/feature_distance.h"
#include "oracle/query/contact.h"
#include "oracle/query/rungs.h"
#include "tests/detector/distance/rational_distance.h"
#include "tests/detector/small_stack.h"
#include "tests/oracle/query/query_kinds.h"

namespace assay::oracle {
namespace {

using detector::Want, test::for_each_kind, test::Random, tests::Rational, tests::squared_distance;

TEST(DistanceLaws, WithinZeroIsContact) {
  Random random(160);
  int contacts = 0;
  const std::uint64_t queries = tests::asked("ASSAY_CASES", 400);
  for_each_kind(random, queries, [&](const FourPoints& q) {
    const ContactAnswer contact = contact_of(q, Want::first_time);
    const ContactAnswer near = first_time_within(q, {0, 0});
    EXPECT_EQ(near.contact, contact.contact);
    EXPECT_TRUE(!near.contact || near.first == contact.first);
    contacts += contact.contact;
  });
  EXPECT_GT(contacts * 10, queries * test::query_kinds);
}

Separation random_distance(Random& random) {
  constexpr double distances[] = {0, 0x1p-20, 0.25, 0.5, 1, 1.5, 2, 3};
  return {distances[random.below(8)], random.below(4) == 0 ? distances[random.below(4)] : 0};
}

// At sampled times, at the enclosure of the first time, and just before it.
TEST(DistanceLaws, AgreesWithRationalTimes) {
  Random random(161);
  int later = 0;
  constexpr int queries = tests::usual(150), samples = 16;
  for_each_kind(random, queries, [&](FourPoints q) {
    if (random.below(5) == 0) {
      for (auto& p : q.points) p.t1 = p.t0;
    }
    const Separation d = random_distance(random);
    const Rational sum = Rational(d.first) + Rational(d.second), squared = sum * sum;
    const ContactAnswer answer = first_time_within(q, d);
    EXPECT_EQ(first_time_within(q, d, Want::yes_no).contact, answer.contact);
    const auto is_within = [&](const Rational& t) { return squared_distance(q, t) <= squared; };
    const auto expect = [&](const Rational& t) {
      EXPECT_TRUE(!is_within(t) || (answer.contact && Rational(answer.first.lo) <= t)) << t;
    };
    for (int s = 0; s <= samples; ++s) expect(Rational(s, samples));
    if (!answer.contact) return;
    const auto [lo, hi] = answer.first;
    later += lo > 0;
    EXPECT_EQ(is_within(Rational(lo)), lo == hi);
    // Within d somewhere between: at hi by rounding alone.
    const Rational at_hi = squared_distance(q, Rational(hi));
    EXPECT_TRUE(lo == hi || std::sqrt(static_cast<double>(at_hi)) <=
                                static_cast<double>(sum) * (1 + 1e-12) + 1e-11);
    if (lo > 0) expect(Rational(std::nextafter(lo, 0)));
    for (int s = 1; s < 8; ++s) expect(Rational(lo) * s / 8);
  });
  EXPECT_GT(later, tests::usual(100));
}

TEST(DistanceLaws, TurnedAndMirroredQueriesAgree) {
  Random random(162);
  for_each_kind(random, 100, [&](const FourPoints& q) {
    const Separation d = random_distance(random);
    const ContactAnswer answer = first_time_within(q, d);
    const auto expect_same = [&](const std::array<int, 4>& order, bool mirrored) {
      FourPoints other = q;
      for (int j = 0; j < 4; ++j) {
        for (int k = 0; k < 3; ++k) {
          const int axis = (k + 1) % 3;
          const double sign = mirrored && k == 0 ? -1 : 1;
          other.points[j].t0[axis] = sign * q.points[order[j]].t0[k];
          other.points[j].t1[axis] = sign * q.points[order[j]].t1[k];
        }
      }
      const ContactAnswer turned = first_time_within(other, {d.second, d.first});
      EXPECT_EQ(turned.contact, answer.contact);
      EXPECT_EQ(turned.first, answer.first) << turned.first.lo << " " << answer.first.lo;
    };
    if (q.first_group == 1) {
      expect_same({0, 2, 3, 1}, false);
      expect_same({0, 2, 1, 3}, true);
    } else {
      expect_same({1, 0, 2, 3}, false);
      expect_same({2, 3, 0, 1}, true);
      expect_same({3, 2, 0, 1}, false);
    }
  });
}

TEST(DistanceLaws, LeastDistanceIsTheLeastThatIsReached) {
  Random random(163);
  int above = 0;
  for_each_kind(random, 12, [&](const FourPoints& q) {
    const double least = least_distance(q);
    EXPECT_TRUE(first_time_within(q, {least, 0}).contact);
    if (least == 0) return;
    ++above;
    EXPECT_FALSE(first_time_within(q, {std::nextafter(least, 0), 0}).contact);
    // Neither is it nearer at any sampled time.
    const Rational before(std::nextafter(least, 0));
    for (int s = 0; s <= 16; ++s) EXPECT_GT(squared_distance(q, Rational(s, 16)), before * before);
  });
  EXPECT_GT(above, 30);
}

FourPoints any_exponents(Random& random, int i) {
  FourPoints q;
  q.first_group = 1 + i % 2;
  const bool flat = i % 5 == 0;
  const bool whole = i % 3 != 0;
  for (auto& p : q.points) {
    for (double* end : {p.t0.data(), p.t1.data()}) {
      for (int k = flat ? 1 : 0; k < 3; ++k)
        end[k] = std::ldexp(whole ? random.integer(2) : random.unit(), random.below(2096) - 1074);
    }
  }
  return q;
}

// None may need a deep stack.
TEST(DistanceLaws, ExponentsOverAllDoubles) {
  tests::expect_enough_stack("distance, exponents over all doubles", [] {
    Random random(164);
    const int queries = static_cast<int>(tests::asked("ASSAY_CASES", 60));
    for (int i = 0; i < queries; ++i) {
      const FourPoints q = any_exponents(random, i);
      const Separation d = {std::ldexp(1 + random.unit() / 2, random.below(2096) - 1074),
                            i % 4 == 0 ? std::ldexp(1.0, random.below(2096) - 1074) : 0};
      const ContactAnswer answer = first_time_within(q, d);
      const ContactAnswer contact = contact_of(q, Want::first_time);
      const ContactAnswer zero = first_time_within(q, {0, 0});
      ASSERT_EQ(zero.contact, contact.contact) << i;
      ASSERT_EQ(zero.first, contact.first) << i;
      ASSERT_TRUE(!contact.contact || (answer.contact && answer.first <= contact.first)) << i;
    }
  });
}

}  // namespace
}  // namespace assay::oracle
