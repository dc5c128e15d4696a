#include "properties/judging/step_errors.h"

#include <nlohmann/json.hpp>

#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Answer, detector::PairContact;

StepErrors read_back(const nlohmann::json& json) {
  StepErrors errors;
  read_fields(json, errors);
  return errors;
}

PairContact meeting(std::int32_t a, std::int32_t b, double time) {
  return {{a, b}, {time, time}, {}};
}

StepErrors errors_of_step(Answer answer, detector::TimeEnclosure first,
                          std::vector<PairContact> reported, std::vector<PairContact> exact,
                          const Claims& claims = {}, bool complete = true) {
  detector::StepResult result;
  result.answer = answer;
  result.first = first;
  result.pairs = std::move(reported);
  oracle::StepJudgement truth;
  truth.complete = complete;
  truth.answer = exact.empty() ? Answer::free : Answer::collision;
  for (const auto& pair : exact) truth.first = std::min(truth.first, pair.time);
  truth.pairs = std::move(exact);
  return errors_of(compare(result, truth, claims, {}, detector::Triangles(0, 3)));
}

const std::vector<PairContact> at_half = {meeting(0, 1, 0.5)};

TEST(StepErrors, EachWordIsMet) {
  const auto missed = errors_of_step(Answer::free, {}, {}, at_half);
  EXPECT_EQ(missed.contact, 1u);
  EXPECT_EQ(missed.missed, 1u);
  EXPECT_EQ(missed.unsafe, 1u);
  EXPECT_EQ(missed.missing, 0u);  // it claims no pairs and reports none
  const auto alarm = errors_of_step(Answer::collision, {0.5, 0.5}, at_half, {});
  EXPECT_EQ(alarm.free, 1u);
  EXPECT_EQ(alarm.false_alarms, 1u);
  EXPECT_EQ(alarm.spurious, 1u);
  EXPECT_EQ(alarm.alarming, 1u);
  EXPECT_EQ(alarm.unsafe, 0u);
  const auto late = errors_of_step(Answer::collision, {0.625, 0.625}, at_half, at_half);
  EXPECT_EQ(late.late.steps, 1u);
  EXPECT_EQ(late.late.worst_share, 0.125);
  EXPECT_EQ(late.unsafe, 1u);
  const auto early = errors_of_step(Answer::collision, {0.25, 1}, at_half, at_half);
  EXPECT_EQ(early.early.worst_share, 0.25);
  EXPECT_EQ(early.unsafe, 0u);
  EXPECT_EQ(early.collisions(), 1u);
}

TEST(StepErrors, AMissingPairIsUnsafeIfPairsAreClaimed) {
  const std::vector<PairContact> two = {meeting(0, 1, 0.5), meeting(2, 3, 0.5)};
  const auto claimed =
      errors_of_step(Answer::collision, {0.5, 0.5}, at_half, two, {Claim::first_pairs});
  EXPECT_EQ(claimed.missing, 1u);
  EXPECT_EQ(claimed.unsafe, 1u);
  const auto not_claimed = errors_of_step(Answer::collision, {0.5, 0.5}, at_half, two);
  EXPECT_EQ(not_claimed.missing, 1u);
  EXPECT_EQ(not_claimed.unsafe, 0u);
}

TEST(StepErrors, WithoutAnAnswerOnlyStepsAndUndecidedCount) {
  for (const auto answer : {Answer::undecided, Answer::error}) {
    const auto errors = errors_of_step(answer, {}, {}, at_half);
    StepErrors expected;
    expected.steps = expected.undecided = 1;
    EXPECT_EQ(errors, expected);
  }
  EXPECT_EQ(errors_of_step(Answer::free, {}, {}, at_half, {}, false), StepErrors{});
}

TEST(StepErrors, TimesAreCountedInDoublesToo) {
  const auto errors =
      errors_of_step(Answer::collision, {std::nextafter(0.5, 1), 1}, at_half, at_half);
  EXPECT_EQ(errors.late.worst_ulps, 1);
  EXPECT_EQ(errors.late.worst_share, 0x1p-53);
  EXPECT_EQ(errors.late.quantile(1), 1.2e-16);  // rounded upward
}

// Late by the least double: also that share is a number in every report.
TEST(StepErrors, TheLeastShareIsANumber) {
  const std::vector<PairContact> at_start = {meeting(0, 1, 0)};
  const double least = std::numeric_limits<double>::denorm_min();
  const auto late = errors_of_step(Answer::collision, {least, least}, at_start, at_start);
  EXPECT_EQ(late.late.steps, 1u);
  EXPECT_GE(late.late.quantile(1), least);
  EXPECT_LT(late.late.quantile(1), 1e-299);
  EXPECT_EQ(read_back(json_of_fields<nlohmann::json>(late)), late);
}

TEST(StepErrors, SumsAndQuantiles) {
  StepErrors sum;
  for (int i = 1; i <= 60; ++i)
    sum += errors_of_step(Answer::collision, {0.5 + 1e-3 * i, 1}, at_half, at_half);
  for (int i = 0; i < 40; ++i) sum += errors_of_step(Answer::free, {}, {}, {});
  EXPECT_EQ(sum.steps, 100u);
  EXPECT_EQ(sum.free, 40u);
  EXPECT_EQ(sum.late.steps, 60u);
  EXPECT_NEAR(sum.late.quantile(0.5), 0.030, 1e-3);
  EXPECT_NEAR(sum.late.quantile(0.99), 0.060, 1e-12);
  EXPECT_EQ(sum.early.quantile(1), 0);
}

TEST(StepErrors, AsJsonAndBack) {
  auto errors = errors_of_step(Answer::collision, {0.625, 0.625}, at_half, at_half);
  errors += errors_of_step(Answer::free, {}, {}, {});
  const auto json = json_of_fields<nlohmann::json>(errors);
  EXPECT_EQ(json.at("late").at("worst_share"), 0.125);
  EXPECT_EQ(read_back(nlohmann::json::parse(json.dump())), errors);
  EXPECT_EQ(nlohmann::ordered_json(errors).begin().key(), "steps");
  EXPECT_FALSE(json.contains("limits")) << "it is no limiter";
  errors.limits.free = 3;
  errors.limits.stalls["t inside"] = 2;
  EXPECT_EQ(read_back(json_of_fields<nlohmann::json>(errors)), errors);
  EXPECT_THROW(read_back(nlohmann::json::object()), nlohmann::json::exception);
}

}  // namespace
}  // namespace assay::properties
