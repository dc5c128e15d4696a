#include "properties/judging/step_measures.h"

#include <nlohmann/json.hpp>

#include "properties/campaign/gates/gates.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// A step in which both answer collision, the detector's time off by so much.
void count_collision(double late, double early, detector::TimeEnclosure stated,
                     StepMeasures& measures) {
  StepDiff diff;
  diff.answer = detector::Answer::collision;
  diff.oracle_complete = true;
  diff.first_contact.emplace();
  diff.first = FirstTimes{stated, {0.5, 0.5}, {late, early}};
  detector::StepResult result;
  result.first = stated;
  measures += measures_of({&diff, 1}, {&result, 1});
}

void count_free(bool alarm, StepMeasures& measures) {
  StepDiff diff;
  diff.answer = alarm ? detector::Answer::collision : detector::Answer::free;
  diff.oracle_complete = diff.nothing_in_contact = true;
  diff.answered_collision = alarm;
  const detector::StepResult result;
  measures += measures_of({&diff, 1}, {&result, 1});
}

TEST(StepMeasures, SurviveTheirJson) {
  StepMeasures m;
  for (int i = 1; i <= 60; ++i) count_collision(1e-3 * i, 0, {0.5, 0.5}, m);
  for (int i = 0; i < 40; ++i) count_collision(0, 0, {0, 1}, m);
  m.redrawn = 7;
  m.errors.limits.free = 3;
  const auto json = json_of_fields<nlohmann::json, Zeros::left_out>(m);
  EXPECT_EQ(json.at("errors").at("limits").at("cut"), 0) << "a limiter's account is whole";
  StepMeasures read;
  read_fields<nlohmann::json, Zeros::left_out>(nlohmann::json::parse(json.dump()), read);
  EXPECT_EQ(read, m);
  EXPECT_EQ((json_of_fields<nlohmann::json, Zeros::left_out>(StepMeasures{}).dump()), "{}");
  StepMeasures none;
  read_fields<nlohmann::json, Zeros::left_out>(nlohmann::json::object(), none);
  EXPECT_EQ(none, StepMeasures{});
  for (const char* odd : {"null", "7", "[]", R"({"errors": null})", R"({"errors": 7})",
                          R"({"errors": {"late": []}})", R"({"errors": {"limits": {"free": 1}}})"})
    EXPECT_THROW((read_fields<nlohmann::json, Zeros::left_out>(nlohmann::json::parse(odd), none)),
                 nlohmann::json::exception)
        << odd;
  EXPECT_EQ(m.errors.collisions(), 100u);
  EXPECT_EQ(m.without_time, 40u);
  // Of the 60 that are late; the 40 others are none of them.
  EXPECT_EQ(m.errors.late.steps, 60u);
  EXPECT_NEAR(m.errors.late.quantile(0.5), 0.030, 1e-12);
  EXPECT_NEAR(m.errors.late.quantile(0.99), 0.060, 1e-12);
}

TEST(StepMeasures, RatesLieInTheirIntervals) {
  StepMeasures counts;
  for (int i = 0; i < 300; ++i) count_free(i % 10 == 0, counts);
  const auto rate = false_alarm_rate(counts);
  EXPECT_EQ(rate.of, 30u);
  EXPECT_EQ(rate.in, 300u);
  // Of 30 in 300, by tables: 6.9 to 14 per cent.
  EXPECT_NEAR(rate.interval.lo, 0.068, 0.002);
  EXPECT_NEAR(rate.interval.hi, 0.140, 0.002);
  EXPECT_EQ(share_interval(0, 0, 0).hi, 1);
  EXPECT_EQ(share_interval(0, 10, 10).lo, 0);
  EXPECT_NEAR(share_interval(0, 10, 10).hi, 0.3085, 1e-4);
  EXPECT_NEAR(share_interval(10, 10, 10).lo, 0.6915, 1e-4);
  EXPECT_EQ(share_interval(10, 10, 10).hi, 1);
  // Steps that hang together say less.
  EXPECT_GT(share_interval(0, 10, 2).hi, share_interval(0, 10, 10).hi);
}

BoundDetector claiming(std::vector<std::string> claims) {
  BoundDetector detector;
  detector.built_in = false;
  detector.configurations = {{"plug-in", std::move(claims)}};
  return detector;
}

TEST(NotJudged, NamesWhatTheContractOrTheTimesMakeVoid) {
  auto detector = claiming({"free-sound", "first-time", "first-pairs", "no-spurious", "total"});
  StepMeasures counts;
  for (int i = 0; i < 100; ++i) count_collision(0, 0, {0.5, 0.5}, counts);
  EXPECT_TRUE(not_judged(detector, counts).empty());

  const auto names = [&](const StepMeasures& of) {
    std::vector<std::string> list;
    for (const auto& one : not_judged(detector, of)) list.push_back(one.claim);
    return list;
  };
  using Names = std::vector<std::string>;
  detector.contract.margin = 0.1;
  EXPECT_EQ(names(counts), (Names{"first-time", "no-spurious"}));
  detector.contract.adjacency = Adjacency::no_shared_vertex;
  EXPECT_EQ(names(counts), Names{"first-time"});
  detector.contract = {.reports = PairReporting::no_pairs};
  EXPECT_EQ(names(counts), Names{"first-pairs"});
  detector.contract = {};
  count_collision(0, 0, {0, 1}, counts);
  EXPECT_TRUE(names(counts).empty());  // one in a hundred
  count_collision(0, 0, {0, 1}, counts);
  EXPECT_EQ(names(counts), Names{"first-time"});
  EXPECT_EQ(names({}), (Names{"free-sound", "first-time", "first-pairs"}));
}

// A step whose answer could not be used had a contact all the same.
TEST(NotJudged, TellsStepsWithoutAContactFromThoseWithoutAnAnswer) {
  const auto detector = claiming({"free-sound"});
  StepMeasures counts;
  const auto reason = [&](std::uint64_t unanswered) {
    counts.unanswered = unanswered;
    return not_judged(detector, counts).at(0).reason;
  };
  EXPECT_EQ(reason(0), "no step had a contact");
  EXPECT_EQ(reason(1), "the one step with a contact has no answer that can be judged");
  EXPECT_EQ(reason(7), "the 7 steps with a contact have no answer that can be judged");
  count_collision(0, 0, {0.5, 0.5}, counts);
  EXPECT_TRUE(not_judged(detector, counts).empty());
}

// The bound of Clopper and Pearson against sums of the binomial distribution, closed forms, and
// values in print.

// The chance of at most k failures in n trials, summed term by term.
double chance_of_at_most(std::uint64_t k, std::uint64_t n, double p) {
  double sum = 0;
  for (std::uint64_t i = 0; i <= k; ++i) {
    const auto count = static_cast<double>(i), all = static_cast<double>(n);
    sum += std::exp(std::lgamma(all + 1) - std::lgamma(count + 1) - std::lgamma(all - count + 1) +
                    count * std::log(p) + (all - count) * std::log1p(-p));
  }
  return sum;
}

TEST(UpperBound, AgreesWithValuesInPrint) {
  // Two-sided 95 % intervals hold one-sided bounds at 2.5 % (Clopper and Pearson 1934, charts;
  // standard tables).
  const std::tuple<std::uint64_t, std::uint64_t, double> printed[] = {
      {10, 100, .1762}, {0, 10, .3085}, {1, 10, .4450}, {5, 10, .8129}, {1, 20, .2487}};
  for (const auto& [failures, trials, bound] : printed)
    EXPECT_NEAR(upper_bound(failures, trials, .025), bound, 5e-5) << failures << " of " << trials;
  // The rule of three: -ln 0.05 = 2.9957 in n, at 95 %.
  EXPECT_NEAR(1e6 * upper_bound(0, 1'000'000, .05), 2.99573, 1e-4);
}

// Of no failure by a closed form, so to more digits.
TEST(UpperBound, LeavesExactlyTheRisk) {
  for (const std::uint64_t n : {1u, 2u, 5u, 10u, 30u, 50u, 100u, 1000u, 4000u, 20'000u, 120'000u}) {
    for (const std::uint64_t k : {0u, 1u, 2u, 4u, 15u, 29u}) {
      for (const double risk : {.05, .01, .05 / 48, .001}) {
        if (k >= n) continue;
        const double p = upper_bound(k, n, risk);
        EXPECT_NEAR(chance_of_at_most(k, n, p) / risk, 1, k == 0 ? 3e-12 : 1e-6)
            << k << " of " << n;
        // A larger share would have had less than that chance.
        EXPECT_LT(chance_of_at_most(k, n, std::min(1., 1.01 * p)), risk);
      }
    }
  }
}

TEST(UpperBound, OfNothingOrOfFailuresAloneIsAll) {
  EXPECT_EQ(upper_bound(0, 0, .05), 1);
  EXPECT_EQ(upper_bound(7, 7, .05), 1);
  EXPECT_EQ(upper_bound(1, 1, .05), 1);
  EXPECT_LT(upper_bound(6, 7, .05), 1);
}

TEST(RiskOfEach, SharesTheFamilyRisk) {
  EXPECT_EQ(risk_of_each(0), .05);
  EXPECT_EQ(risk_of_each(1), .05);
  for (const std::uint64_t bounds : {2u, 8u, 48u}) {
    const double each = risk_of_each(bounds);
    EXPECT_NEAR(each * static_cast<double>(bounds), .05, 1e-15);
    // Bonferroni: even independent bounds hold together with at least 95 %.
    EXPECT_GE(std::pow(1 - each, static_cast<double>(bounds)), .95);
  }
}

// What the plans want is in reach of their sizes when nothing fails.
TEST(UpperBound, OfThePlansIsInReach) {
  // At most 24 strata, 10 configurations, at most 8 claims each.
  const double risk = risk_of_each(24 * 10 * 8);
  EXPECT_LE(upper_bound(0, 4000, risk), 5e-3);
  EXPECT_LE(upper_bound(0, 1500, risk), 5e-2);
  EXPECT_LE(upper_bound(0, 20'000, risk), 1e-3);
  EXPECT_LE(upper_bound(0, 60'000, risk), 2e-4);
  EXPECT_GT(upper_bound(0, 1000, risk), 5e-3);
}

}  // namespace
}  // namespace assay::properties
