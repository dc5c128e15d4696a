#include "properties/campaign/stored/step_measures.h"

#include <gtest/gtest.h>

#include "properties/campaign/gates/measure_rates.h"
#include "properties/campaign/gates/not_judged.h"

namespace assay::properties {
namespace {

// A step in which both answer collision, the detector's time off by so much.
void count_collision(double late, double early, detector::TimeEnclosure stated, Counts& counts) {
  StepDiff diff;
  diff.first_contact.emplace();
  diff.first = FirstTimes{stated, {0.5, 0.5}, {late, early}};
  detector::StepResult result;
  result.answer = detector::Answer::collision;
  result.first = stated;
  oracle::StepJudgement truth;
  truth.complete = true;
  truth.answer = detector::Answer::collision;
  truth.pairs.emplace_back();
  count_measures({&diff, 1}, {&result, 1}, {&truth, 1}, counts);
}

void count_free(bool alarm, Counts& counts) {
  StepDiff diff;
  diff.answered_collision = alarm;
  detector::StepResult result;
  result.answer = alarm ? detector::Answer::collision : detector::Answer::free;
  oracle::StepJudgement truth;
  truth.complete = true;
  truth.answer = detector::Answer::free;
  count_measures({&diff, 1}, {&result, 1}, {&truth, 1}, counts);
}

TEST(StepMeasures, QuantilesOfWhatIsOff) {
  Counts counts;
  for (int i = 1; i <= 60; ++i) count_collision(1e-3 * i, 0, {0.5, 0.5}, counts);
  for (int i = 0; i < 40; ++i) count_collision(0, 0, {0.5, 0.5}, counts);
  const auto m = measures_in(parse_counts(counts_text(counts)));
  EXPECT_EQ(m.collisions, 100u);
  EXPECT_EQ(m.late_steps(), 60u);
  const auto off = times_late(m);
  // Of the 60 that are late; the 40 others are none of them.
  EXPECT_NEAR(off.median, 0.030, 1e-12);
  EXPECT_NEAR(off.p99, 0.060, 1e-12);
  EXPECT_NEAR(off.worst, 0.060, 1e-12);
  EXPECT_EQ(times_early(m).worst, 0);
}

// What claims not-late alone answers a step size, [size, 1]: that is early by what is left to t*.
TEST(StepMeasures, AStepSizeIsEarly) {
  const detector::Triangles triangles(0, 3);
  oracle::StepJudgement truth;
  truth.complete = true;
  truth.answer = detector::Answer::collision;
  truth.pairs = {{{0, 1}, {0.75, 0.75}, {}}};
  detector::StepResult result;
  result.answer = detector::Answer::collision;
  result.first = {0.25, 1};
  const auto diff = compare(result, truth, {Claim::not_late}, {}, triangles);
  EXPECT_EQ(diff.outcome, Outcome::holds);
  Counts counts;
  count_measures({&diff, 1}, {&result, 1}, {&truth, 1}, counts);
  const auto m = measures_in(counts);
  EXPECT_EQ(m.early_steps(), 1u);
  EXPECT_EQ(times_early(m).median, 0.5);
  EXPECT_EQ(m.late_steps(), 0u);
}

TEST(StepMeasures, AreRoundedUp) {
  Counts counts;
  count_collision(1.01e-17, 0, {0.5, 0.5}, counts);
  EXPECT_EQ(worst_of(measures_in(counts).late), 1.1e-17);
  Counts exact;
  count_collision(0.12, 0, {0.5, 0.5}, exact);
  EXPECT_EQ(worst_of(measures_in(exact).late), 0.12);
}

TEST(StepMeasures, TheRateOfAlarmsLiesInItsInterval) {
  Counts counts;
  for (int i = 0; i < 300; ++i) count_free(i % 10 == 0, counts);
  const auto rate = false_alarm_rate(measures_in(counts));
  EXPECT_EQ(rate.of, 30u);
  EXPECT_EQ(rate.in, 300u);
  // Of 30 in 300, by tables: 6.9 to 14 per cent.
  EXPECT_NEAR(rate.interval.lo, 0.068, 0.002);
  EXPECT_NEAR(rate.interval.hi, 0.140, 0.002);
}

TEST(StepMeasures, IntervalsAtTheEnds) {
  EXPECT_EQ(share_interval(0, 0, 0).hi, 1);
  EXPECT_EQ(share_interval(0, 10, 10).lo, 0);
  EXPECT_NEAR(share_interval(0, 10, 10).hi, 0.3085, 1e-4);
  EXPECT_NEAR(share_interval(10, 10, 10).lo, 0.6915, 1e-4);
  EXPECT_EQ(share_interval(10, 10, 10).hi, 1);
  // Steps that hang together say less.
  EXPECT_GT(share_interval(0, 10, 2).hi, share_interval(0, 10, 10).hi);
}

TEST(NotJudged, NamesWhatTheContractOrTheTimesMakeVoid) {
  BoundDetector detector;
  detector.built_in = false;
  detector.configurations = {
      {"plug-in", {"free-sound", "first-time", "first-pairs", "no-spurious", "total"}}};
  Counts counts;
  for (int i = 0; i < 100; ++i) count_collision(0, 0, {0.5, 0.5}, counts);
  EXPECT_TRUE(not_judged(detector, measures_in(counts)).empty());

  const auto names = [&](const Counts& of) {
    std::vector<std::string> list;
    for (const auto& one : not_judged(detector, measures_in(of))) list.push_back(one.claim);
    return list;
  };
  using Names = std::vector<std::string>;
  detector.contract.margin = 0.1;
  EXPECT_EQ(names(counts), Names{"no-spurious"});
  detector.contract = {.reports_pairs = false};
  EXPECT_EQ(names(counts), Names{"first-pairs"});
  detector.contract = {};
  count_collision(0, 0, {0, 1}, counts);
  EXPECT_TRUE(names(counts).empty());  // one in a hundred
  count_collision(0, 0, {0, 1}, counts);
  EXPECT_EQ(names(counts), Names{"first-time"});
  EXPECT_EQ(names({}), (Names{"free-sound", "first-time", "first-pairs"}));
}

}  // namespace
}  // namespace assay::properties
