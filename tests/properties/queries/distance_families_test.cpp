// The families of distance queries: each query can be made alone, the constructed ones keep their
// promises, the referee is right about them and leaves few open, and the comparison with a method
// finds what is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "oracle/query/contact.h"
#include "properties/queries/distance_queries.h"
#include "properties/queries/self_check.h"
#include "tests/detector/distance/rational_distance.h"

namespace assay::properties {
namespace {

using detector::Decision;
using oracle::DistanceVerdict;
using tests::Rational;

constexpr std::uint64_t seed = 3;

Rational fraction(const oracle::RationalTime& t) { return {t.numerator, t.denominator}; }
Rational squared_limit(const DistanceQuery& q) {
  const Rational d = Rational(q.distance.first) + Rational(q.distance.second);
  return d * d;
}
Rational squared_at(const DistanceQuery& q, const Rational& t) {
  return tests::squared_distance(q.motion, t);
}

TEST(DistanceFamilies, EveryQueryCanBeMadeAlone) {
  for (const DistanceFamily& family : distance_families()) {
    int differ = 0;
    for (std::uint64_t index = 0; index < 20; ++index) {
      const std::string text = exact_text(family.make(5, index));
      const auto again = self_test_case(std::string(family.name) + ":5:" + std::to_string(index));
      ASSERT_TRUE(again.has_value());
      EXPECT_TRUE(again->family->text(again->seed, again->index).starts_with(text));
      differ += exact_text(family.make(6, index)) != text;
    }
    EXPECT_GE(differ, 19) << family.name;
  }
}

TEST(DistanceFamilies, ConstructedOnesKeepTheirPromises) {
  for (const DistanceFamily& family : distance_families()) {
    int promised = 0, exactly = 0;
    for (std::uint64_t index = 0; index < 300; ++index) {
      const DistanceQuery q = family.make(seed, index);
      ASSERT_GE(Rational(q.distance.first) + Rational(q.distance.second), 0)
          << family.name << index;
      if (!q.near_at) continue;
      const Rational at = squared_at(q, Rational(*q.near_at)), limit = squared_limit(q);
      EXPECT_LE(at, limit) << family.name << ":" << seed << ":" << index;
      ++promised;
      exactly += at == limit;
    }
    std::printf("%-22s %3d of 300 are known to be near, %3d of them exactly at d\n", family.name,
                promised, exactly);
    const std::string name = family.name;
    if (name == "distance-tangent" || name == "distance-no-normal" || name == "distance-ends") {
      EXPECT_EQ(exactly, 300);
    }
  }
}

// Distances at seven times of the step, exact, against the verdict; and its share of open ones.
TEST(DistanceFamilies, TheRefereeIsRightAndLeavesFewOpen) {
  for (const DistanceFamily& family : distance_families()) {
    DistanceTally tally;
    const int queries = family.one_in == 1 ? 250 : family.one_in < 100 ? 100 : 50;
    for (int index = 0; index < queries; ++index) {
      SCOPED_TRACE(std::string(family.name) + ":" + std::to_string(seed) + ":" +
                   std::to_string(index));
      const DistanceQuery q = family.make(seed, static_cast<std::uint64_t>(index));
      const auto wrong = check_distance(q, {}, tally);
      EXPECT_FALSE(wrong.has_value()) << *wrong;
      const DistanceVerdict verdict = ask_distance_referee(q);
      const Rational limit = squared_limit(q), after = fraction(verdict.after);
      for (int k = 0; k <= 6; ++k) {
        const Rational t = Rational(k) / 6;
        const bool is_near = squared_at(q, t) <= limit;
        if (verdict.within == Decision::no) {
          EXPECT_FALSE(is_near) << k;
        } else if (verdict.within == Decision::yes && verdict.by.numerator == 0) {
          EXPECT_TRUE(is_near || k > 0);
        } else if (t <= after) {
          EXPECT_FALSE(is_near) << k;
        }
      }
    }
    std::printf("%-22s %4d queries, %4d near, %4d far, open %5.2f %%, %5.1f cells, at most %d\n",
                family.name, queries, static_cast<int>(tally.near), static_cast<int>(tally.far),
                100 * tally.open_share(), static_cast<double>(tally.cells) / queries,
                static_cast<int>(tally.most_cells));
    EXPECT_LE(tally.open_share(), family.most_open) << family.name;
    EXPECT_EQ(tally.contradictions, 0U);
    EXPECT_GT(tally.near, 0U) << family.name;
  }
}

// Without a distance the question is that of contact, which the oracle answers on its own.
TEST(DistanceChecks, ContactsOfTheOracleAgree) {
  const DistanceMethod contacts = [](const DistanceQuery& q) {
    const auto answer = oracle::contact_of(q.motion, detector::Want::first_time);
    return DistanceAnswer{answer.contact, answer.first};
  };
  const auto families = distance_families();
  const auto zero = std::find_if(families.begin(), families.end(), [](const auto& family) {
    return family.name == std::string("distance-zero");
  });
  DistanceTally tally;
  for (std::uint64_t index = 0; index < 2000; ++index) {
    DistanceQuery q = families[index % 3].make(seed, index);
    q.distance = {};
    q.near_at.reset();
    for (const auto& asked : {q, zero->make(1, index)}) {
      const auto wrong = check_distance(asked, contacts, tally);
      EXPECT_FALSE(wrong.has_value()) << *wrong << "\n" << exact_text(asked);
    }
  }
  std::printf("%d near, %d far, %d open\n", static_cast<int>(tally.near),
              static_cast<int>(tally.far), static_cast<int>(tally.open));
  EXPECT_GT(tally.near, 800U);
  EXPECT_GT(tally.far, 800U);
  EXPECT_LE(tally.open_share(), 0.02);
}

// A method that is right where the referee is sure, and what is wrong with it on purpose.
TEST(DistanceChecks, WrongAnswersAreFound) {
  int checked = 0;
  for (const DistanceFamily& family : distance_families()) {
    for (std::uint64_t index = 0; index < 40; ++index) {
      DistanceQuery q = family.make(seed, index);
      q.near_at.reset();
      const DistanceVerdict verdict = ask_distance_referee(q);
      if (verdict.within == Decision::open) continue;
      ++checked;
      const bool is_near = verdict.within == Decision::yes;
      const bool is_at_start = is_near && verdict.by.numerator == 0;
      const auto after = static_cast<double>(fraction(verdict.after)),
                 by = static_cast<double>(fraction(verdict.by));
      const auto found = [&](const DistanceAnswer& answer) {
        return contradiction(q, answer, verdict).has_value();
      };
      if (!is_near) {
        EXPECT_FALSE(found({}));
        EXPECT_TRUE(found({true, {.5, .5}}));
        continue;
      }
      EXPECT_TRUE(found({}));  // a near pair that is missed
      if (is_at_start) {
        EXPECT_FALSE(found({true, {0, 0}}));
        EXPECT_TRUE(found({true, {0, 0x1p-1074}}));
        EXPECT_TRUE(found({true, {0x1p-1074, 0x1p-1074}}));
        continue;
      }
      const double middle = after / 2 + by / 2;
      EXPECT_FALSE(found({true, {middle, std::nextafter(middle, 1)}}));
      EXPECT_TRUE(found({true, {0, 0}}));
      EXPECT_TRUE(after == 0 || found({true, {after / 2, after / 2}}));
      EXPECT_TRUE(by == 1 || found({true, {std::nextafter(by, 1), 1}}));
    }
  }
  EXPECT_GT(checked, 400);
}

DistanceAnswer at(double lo, double hi) { return {true, {lo, hi}}; }

TEST(DistanceChecks, EndsOfBrackets) {
  const DistanceQuery q{};
  const DistanceVerdict yes = {Decision::yes, {1, 4}, {1, 2}, 0};
  // The first time is in (1/4, 1/2].
  EXPECT_TRUE(contradiction(q, at(.25, .25), yes).has_value());
  EXPECT_TRUE(contradiction(q, at(.125, .25), yes).has_value());
  EXPECT_FALSE(contradiction(q, at(.25, .375), yes).has_value());
  EXPECT_FALSE(contradiction(q, at(.5, .5), yes).has_value());
  EXPECT_TRUE(contradiction(q, at(.5, .625), yes).has_value());
  const DistanceVerdict open = {Decision::open, {1, 4}, {1, 1}, 0};
  EXPECT_TRUE(contradiction(q, at(.25, .25), open).has_value());
  EXPECT_FALSE(contradiction(q, at(.75, .75), open).has_value());
  EXPECT_FALSE(contradiction(q, {}, open).has_value());
  // A time that is known by construction refutes both the method and the referee.
  DistanceQuery known{};
  known.near_at = .25;
  EXPECT_TRUE(contradiction(known, at(.5, .5), open).has_value());
  EXPECT_TRUE(contradiction(known, {}, open).has_value());
  EXPECT_TRUE(contradiction(known, yes).has_value());
  EXPECT_TRUE(contradiction(known, {Decision::no, {1, 1}, {1, 1}, 0}).has_value());
  EXPECT_FALSE(contradiction(known, {Decision::yes, {0, 1}, {0, 1}, 0}).has_value());
  EXPECT_FALSE(contradiction(known, {Decision::open, {1, 8}, {1, 1}, 0}).has_value());
}

TEST(DistanceChecks, AMethodThatThrowsContradicts) {
  DistanceTally tally;
  const DistanceMethod thrower = [](const DistanceQuery&) -> DistanceAnswer {
    throw std::runtime_error("no memory");
  };
  const auto wrong = check_distance(DistanceQuery{}, thrower, tally);
  ASSERT_TRUE(wrong.has_value());
  EXPECT_NE(wrong->find("no memory"), std::string::npos);
  EXPECT_EQ(tally.contradictions, 1U);
}

}  // namespace
}  // namespace assay::properties
