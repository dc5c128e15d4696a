// The families of distance queries: each query can be made alone, the constructed queries have the
// promised distances, the referee is right about them and leaves few open, and the comparison with
// a wrong method finds its errors.
#include <fmt/format.h>

#include "properties/queries/query_families.h"
#include "properties/queries/query_methods.h"
#include "properties/queries/self_check.h"
#include "tests/detector/distance/rational_distance.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Decision, oracle::DistanceVerdict, tests::Rational;

constexpr std::uint64_t seed = 3;

Rational fraction(const oracle::RationalTime& t) { return {t.numerator, t.denominator}; }
Rational squared_limit(const QueryTask& q) {
  const Rational d = Rational(q.within->first) + Rational(q.within->second);
  return d * d;
}
Rational squared_at(const QueryTask& q, const Rational& t) {
  return tests::squared_distance(q.query, t);
}

DistanceVerdict verdict_of(const QueryTask& q) {
  const auto referee =
      std::ranges::find(query_methods(), std::string_view("distance referee"), &QueryMethod::name);
  return referee->answer(q).proof.value();
}

TEST(DistanceFamilies, EveryQueryCanBeMadeAlone) {
  const auto all = self_test_families(ASSAY_SOURCE_DIR "/corpus").value();
  for (const Family& family : distance_families()) {
    int differ = 0;
    for (std::uint64_t index = 0; index < 20; ++index) {
      const std::string text = exact_text(family.query(5, index));
      differ += exact_text(family.query(6, index)) != text;
      if (index >= 4) continue;  // the whole text asks the referee
      const auto again = self_test_case(all, fmt::format("{}:5:{}", family.name, index));
      ASSERT_TRUE(again.has_value());
      EXPECT_TRUE(again->family->text(again->seed, again->index).starts_with(text));
    }
    EXPECT_GE(differ, 19) << family.name;
  }
}

TEST(DistanceFamilies, ConstructedOnesKeepTheirPromises) {
  for (const Family& family : distance_families()) {
    int promised = 0, exactly = 0;
    for (std::uint64_t index = 0; index < 300; ++index) {
      const QueryTask q = family.query(seed, index);
      ASSERT_GE(Rational(q.within->first) + Rational(q.within->second), 0) << family.name << index;
      if (!q.met_at) continue;
      const Rational at = squared_at(q, Rational(*q.met_at)), limit = squared_limit(q);
      EXPECT_LE(at, limit) << family.name << ":" << seed << ":" << index;
      ++promised;
      exactly += at == limit;
    }
    fmt::print("{:<22} {:3} of 300 are known to be near, {:3} of them exactly at d\n", family.name,
               promised, exactly);
    const std::set<std::string_view> exact = {"distance-tangent", "distance-no-normal",
                                              "distance-ends"};
    EXPECT_TRUE(exactly == 300 || !exact.contains(family.name)) << family.name;
  }
}

// Distances at seven times of the step, exact, against the verdict; and its share of open ones.
TEST(DistanceFamilies, TheRefereeIsRightAndLeavesFewOpen) {
  for (const Family& family : distance_families()) {
    int near = 0, open = 0;
    const int queries = family.one_in == 1 ? 250 : family.one_in < 100 ? 100 : 50;
    for (int index = 0; index < queries; ++index) {
      SCOPED_TRACE(fmt::format("{}:{}:{}", family.name, seed, index));
      const QueryTask q = family.query(seed, static_cast<std::uint64_t>(index));
      const DistanceVerdict verdict = verdict_of(q);
      EXPECT_FALSE(contradicts({.decision = verdict.within, .proof = verdict}, {}, q));
      near += verdict.within == Decision::yes;
      open += verdict.within == Decision::open;
      const Rational limit = squared_limit(q), after = fraction(verdict.after);
      for (int k = 0; k <= 6; ++k) {
        const Rational t = Rational(k) / 6;
        const bool is_near = squared_at(q, t) <= limit;
        const bool starts_near = verdict.within == Decision::yes && verdict.by.numerator == 0;
        EXPECT_TRUE(is_near || k > 0 || !starts_near);
        const bool is_far = verdict.within == Decision::no || (!starts_near && t <= after);
        EXPECT_FALSE(is_near && is_far) << k;
      }
    }
    const double open_share = static_cast<double>(open) / queries;
    fmt::print("{:<22} {:4} queries, {:4} near, open {:5.2f} %\n", family.name, queries, near,
               100 * open_share);
    EXPECT_LE(open_share, family.name == "distance-generic" ? 0.02 : 0.5) << family.name;
    EXPECT_GT(near, 0) << family.name;
  }
}

// Without a distance the question is that of contact, which the oracle answers on its own.
TEST(DistanceChecks, ContactsOfTheOracleAgree) {
  const auto families = distance_families();
  const auto zero = std::ranges::find(families, "distance-zero", &Family::name);
  QueryTally tally;
  for (std::uint64_t index = 0; index < 2000; ++index) {
    QueryTask q = families[index % 3].query(seed, index);
    q.within = detector::Separation{};
    q.met_at.reset();
    for (const auto& asked : {q, zero->query(1, index)}) {
      const auto wrong = check_query(asked, 1, tally);
      EXPECT_FALSE(wrong.has_value()) << *wrong << "\n" << exact_text(asked);
    }
  }
  fmt::print("{} near, {} open, of 4000\n", tally.contacts, tally.open);
  EXPECT_GT(tally.contacts, 800U);
  EXPECT_LT(tally.contacts + tally.open, 3200U);
  EXPECT_LE(tally.open, 80U);
}

const MethodAnswer never = {Decision::no};
MethodAnswer at(double lo, double hi) { return {Decision::yes, detector::TimeEnclosure{lo, hi}}; }

// Whether the oracle's answer and the verdict of the referee are told to contradict each other, or
// what is known.
bool is_contradicted(const QueryTask& q, const MethodAnswer& answer,
                     const DistanceVerdict& verdict) {
  return contradicts({.decision = verdict.within, .proof = verdict}, answer, q) ||
         contradicts(answer, answer, q);
}

TEST(DistanceChecks, EndsOfBrackets) {
  const QueryTask q = {{}, {}, detector::Separation{}};
  const DistanceVerdict yes = {Decision::yes, {1, 4}, {1, 2}, 0};
  // The first time is in (1/4, 1/2].
  for (const auto& answer : {at(0, 0), at(.25, .25), at(.125, .25), at(.5, .625)})
    EXPECT_TRUE(is_contradicted(q, answer, yes)) << answer.first->lo;
  for (const auto& answer : {at(.25, .375), at(.5, .5)})
    EXPECT_FALSE(is_contradicted(q, answer, yes)) << answer.first->lo;
  EXPECT_TRUE(is_contradicted(q, never, yes));
  const DistanceVerdict no = {Decision::no, {1, 1}, {1, 1}, 0};
  EXPECT_FALSE(is_contradicted(q, never, no));
  EXPECT_TRUE(is_contradicted(q, at(.5, .5), no));
  const DistanceVerdict at_start = {Decision::yes, {0, 1}, {0, 1}, 0};
  EXPECT_FALSE(is_contradicted(q, at(0, 0), at_start));
  EXPECT_TRUE(is_contradicted(q, at(0, 0x1p-1074), at_start));
  EXPECT_TRUE(is_contradicted(q, at(0x1p-1074, 0x1p-1074), at_start));
  const DistanceVerdict open = {Decision::open, {1, 4}, {1, 1}, 0};
  EXPECT_TRUE(is_contradicted(q, at(.25, .25), open));
  EXPECT_FALSE(is_contradicted(q, at(.75, .75), open));
  EXPECT_FALSE(is_contradicted(q, never, open));
  // A time that is known by construction refutes both the method and the referee.
  QueryTask known = q;
  known.met_at = .25;
  EXPECT_TRUE(is_contradicted(known, at(.5, .5), open));
  EXPECT_TRUE(is_contradicted(known, never, open));
  EXPECT_TRUE(is_contradicted(known, {}, yes));
  EXPECT_TRUE(is_contradicted(known, {}, no));
  EXPECT_FALSE(is_contradicted(known, {}, at_start));
  EXPECT_FALSE(is_contradicted(known, {}, {Decision::open, {1, 8}, {1, 1}, 0}));
}

TEST(DistanceChecks, AMethodThatThrowsContradicts) {
  const QueryMethod thrower = {
      "thrower", [](const QueryTask&) -> MethodAnswer { throw std::runtime_error("no memory"); },
      QueryChecks::distances};
  QueryTally tally;
  const auto wrong =
      check_query({{}, {}, detector::Separation{}}, 0, tally, std::span(&thrower, 1));
  ASSERT_TRUE(wrong.has_value());
  EXPECT_NE(wrong->find("no memory"), std::string::npos);
  EXPECT_EQ(tally.contradictions, 1U);
}

}  // namespace
}  // namespace assay::properties
