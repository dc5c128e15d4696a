#include "properties/campaign/ledger/step_measures.h"

#include <nlohmann/json.hpp>

#include "properties/campaign/gates/not_judged.h"
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
  const auto errors = measures_of({&diff, 1}, {&result, 1}).errors;
  EXPECT_EQ(errors.early.steps, 1u);
  EXPECT_EQ(errors.early.quantile(0.5), 0.5);
  EXPECT_EQ(errors.late.steps, 0u);
}

TEST(StepMeasures, TheRateOfAlarmsLiesInItsInterval) {
  StepMeasures counts;
  for (int i = 0; i < 300; ++i) count_free(i % 10 == 0, counts);
  const auto rate = false_alarm_rate(counts);
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
  detector.contract = {.reports_pairs = false};
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
  BoundDetector detector;
  detector.built_in = false;
  detector.configurations = {{"plug-in", {"free-sound"}}};
  StepMeasures counts;
  EXPECT_EQ(not_judged(detector, counts).at(0).reason, "no step had a contact");
  counts.unanswered = 1;
  EXPECT_EQ(not_judged(detector, counts).at(0).reason,
            "the one step with a contact has no answer that can be judged");
  counts.unanswered = 7;
  EXPECT_EQ(not_judged(detector, counts).at(0).reason,
            "the 7 steps with a contact have no answer that can be judged");
  count_collision(0, 0, {0.5, 0.5}, counts);
  EXPECT_TRUE(not_judged(detector, counts).empty());
}

}  // namespace
}  // namespace assay::properties
