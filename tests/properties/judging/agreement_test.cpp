// The diff must find what is wrong: each kind of difference is planted once.
#include "properties/judging/agreement.h"

#include "detector/step_result.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Answer, detector::PairContact;

detector::StepResult result_with(std::vector<PairContact> pairs) {
  detector::StepResult result;
  result.answer = pairs.empty() ? Answer::free : Answer::collision;
  for (const auto& p : pairs) {
    if (result.pairs.empty() || p.time < result.first) result.first = p.time;
    result.pairs.push_back(p);
  }
  return result;
}

oracle::StepJudgement judgement_with(std::vector<PairContact> pairs) {
  oracle::StepJudgement judgement;
  const auto same = result_with(std::move(pairs));
  judgement.answer = same.answer;
  judgement.complete = true;
  judgement.first = same.first;
  judgement.pairs = same.pairs;
  return judgement;
}

PairContact contact(std::int32_t a, std::int32_t b, double time) {
  return {{a, b}, {time, time}, {}};
}

const Claims first_alone = claims_of({.pairs = detector::Pairs::first});

StepDiff diff_of(std::vector<PairContact> ours, std::vector<PairContact> theirs,
                 const Claims& claims = claims_of({})) {
  return compare(result_with(std::move(ours)), judgement_with(std::move(theirs)), claims);
}

TEST(Agreement, EqualHolds) {
  EXPECT_EQ(diff_of({}, {}).outcome, Outcome::holds);
  EXPECT_EQ(diff_of({contact(0, 1, .5)}, {contact(0, 1, .5)}).outcome, Outcome::holds);
}

TEST(Agreement, EveryDifferenceIsADefect) {
  const auto wrong_answer = diff_of({}, {contact(0, 1, .5)});
  EXPECT_TRUE(wrong_answer.wrong_answer());
  EXPECT_EQ(wrong_answer.outcome, Outcome::defect);
  const auto missing = diff_of({contact(0, 1, .5)}, {contact(0, 1, .5), contact(2, 3, .75)});
  EXPECT_EQ(missing.missing.size(), 1u);
  EXPECT_EQ(missing.outcome, Outcome::defect);
  const auto spurious = diff_of({contact(0, 1, .5), contact(2, 3, .75)}, {contact(0, 1, .5)});
  EXPECT_EQ(spurious.spurious.size(), 1u);
  EXPECT_EQ(spurious.outcome, Outcome::defect);
  const auto late =
      diff_of({contact(0, 1, .5), contact(2, 3, .75)}, {contact(0, 1, .5), contact(2, 3, .7)});
  EXPECT_EQ(late.late.size(), 1u);
  EXPECT_EQ(late.outcome, Outcome::defect);
  const auto early = diff_of({contact(0, 1, .5)}, {contact(0, 1, .6)});
  EXPECT_EQ(early.early.size(), 1u);
  EXPECT_TRUE(early.wrong_first_time());
}

TEST(Agreement, L6_PairsFirstExcusesLaterPairsAndOtherPairsOfAReportedPlace) {
  // 0-1 and 1-2 meet at t*, one place; 4-5 later.
  const std::vector<PairContact> truth = {contact(0, 1, .5), contact(1, 2, .5), contact(4, 5, .75)};
  const auto excused = diff_of({contact(0, 1, .5)}, truth, first_alone);
  EXPECT_EQ(excused.outcome, Outcome::holds);
  EXPECT_EQ(excused.excused.size(), 2u);
  const std::vector<PairContact> two_places = {contact(0, 1, .5), contact(6, 7, .5)};
  const auto lost_place = diff_of({contact(0, 1, .5)}, two_places, first_alone);
  EXPECT_EQ(lost_place.outcome, Outcome::defect);
  EXPECT_EQ(lost_place.missing.size(), 1u);
}

TEST(Agreement, StoppedOracleIsUndecidedButItsPairsCount) {
  auto judgement = judgement_with({contact(0, 1, .5)});
  judgement.complete = false;
  judgement.answer = Answer::undecided;
  EXPECT_EQ(compare(result_with({contact(0, 1, .5), contact(2, 3, .5)}), judgement, claims_of({}))
                .outcome,
            Outcome::undecided);
  EXPECT_EQ(compare(result_with({contact(2, 3, .5)}), judgement, claims_of({})).outcome,
            Outcome::defect);
}

TEST(Agreement, StoppedOracleAndPairsFirst) {
  auto judgement = judgement_with({contact(0, 1, .5), contact(2, 3, .75)});
  judgement.complete = false;
  judgement.answer = Answer::undecided;
  const auto later = compare(result_with({contact(0, 1, .5)}), judgement, first_alone);
  EXPECT_EQ(later.outcome, Outcome::undecided);
  EXPECT_EQ(later.excused.size(), 1u);
  EXPECT_EQ(compare(result_with({contact(4, 5, .6)}), judgement, first_alone).outcome,
            Outcome::defect);
}

TEST(Agreement, StoppedOracleStillShowsATimeThatIsTooLate) {
  auto judgement = judgement_with({contact(0, 1, .5)});
  judgement.complete = false;
  judgement.answer = Answer::undecided;
  EXPECT_EQ(compare(result_with({contact(0, 1, .6)}), judgement, claims_of({})).outcome,
            Outcome::defect);
  EXPECT_EQ(compare(result_with({contact(0, 1, .4)}), judgement, claims_of({})).outcome,
            Outcome::undecided);
}

TEST(Agreement, StoppedDetectorIsUndecidedAndSpuriousPairsCount) {
  auto result = result_with({contact(0, 1, .5)});
  result.answer = Answer::undecided;
  EXPECT_EQ(compare(result, judgement_with({contact(0, 1, .5), contact(2, 3, .5)}), claims_of({}))
                .outcome,
            Outcome::undecided);
  EXPECT_EQ(compare(result, judgement_with({contact(2, 3, .5)}), claims_of({})).outcome,
            Outcome::defect);
}

}  // namespace
}  // namespace assay::properties
