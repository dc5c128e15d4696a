// A case player does what a caller of the detector would do by hand with the script of the case.
#include "properties/worker/case_run.h"
#include "tests/curated_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Culling, detector::Detector, detector::StepResult, detector::ViewPrimitive;

CasePlayer player_of(const corpus::Case& c, const detector::Options& options) {
  return CasePlayer::make(c, options).value();
}

// In all but the counts that rest on evaluations before, committed or not.
bool same(const StepResult& a, const StepResult& b) {
  return same_answers(without_marking_counts({a}), without_marking_counts({b}));
}

bool same_ends(const ViewPrimitive& a, const ViewPrimitive& b) {
  return a.q0.t0 == b.q0.t0 && a.q0.t1 == b.q0.t1 && a.q1.t0 == b.q1.t0 && a.q1.t1 == b.q1.t1;
}

TEST(CasePlayer, CommitsAndEvaluatesAsScripted) {
  const auto c = tests::curated_case("F_evaluation_kept");
  ASSERT_EQ(c.script, (std::vector<corpus::CaseStep>{{0, 1, true}, {1, 1, false}, {1, 2, true}}));
  const auto& x = c.frames;
  for (const auto culling : all_values<Culling>) {
    SCOPED_TRACE(static_cast<int>(culling));
    auto player = player_of(c, {culling});
    auto by_hand = Detector::create(c.triangles, x[0], {culling}).value();
    ASSERT_EQ(player.steps(), 3u);
    EXPECT_TRUE(same(player.play(0), by_hand.step(x[0], x[1])));
    EXPECT_TRUE(player.detector().commit()) << "the step was not committed";
    EXPECT_TRUE(same(player.play(1), by_hand.evaluate(x[1], x[1])));
    EXPECT_TRUE(same(player.play(2), by_hand.step(x[1], x[2])));
    EXPECT_TRUE(same(player.play(1), by_hand.evaluate(x[1], x[1])));
    EXPECT_FALSE(player.detector().commit()) << "the evaluation was committed";
  }
}

TEST(CasePlayer, KnowsWhereEachStepStartsAndEndsAndOfARefusedMeshThereIsNone) {
  auto c = tests::curated_case("F_start_elsewhere");
  const auto player = player_of(c, {});
  ASSERT_EQ(player.steps(), 2u);
  EXPECT_EQ(player.step(1), (corpus::CaseStep{2, 3, true}));
  EXPECT_EQ(&player.x_t0(1), &c.frames[2]);
  EXPECT_EQ(&player.x_t1(1), &c.frames[3]);
  c.triangles(0, 1) = c.triangles(0, 0);
  const auto made = CasePlayer::make(c, {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().error, detector::InputError::repeated_index);
  EXPECT_EQ(made.error().message, Detector::create(c.triangles, c.frames[0], {}).error().message);
}

TEST(CasePlayer, GivesTheStatedViewToACullingThatLooks) {
  const auto c = tests::curated_case("F_line_nearer_end");
  const auto line = corpus::view_of_step(c, 0).value();
  ASSERT_FALSE(line.is_point());
  const ViewPrimitive point{line.q0, line.q0};
  for (const auto culling : all_values<Culling>) {
    SCOPED_TRACE(static_cast<int>(culling));
    const auto given = given_view(line, culling);
    ASSERT_EQ(given.size(), uses_views(culling) ? 1u : 0u);
    EXPECT_TRUE(given.empty() ||
                same_ends(given[0], culling == Culling::view_point ? point : line));
    EXPECT_TRUE(given_view(std::nullopt, culling).empty());
    auto by_hand = Detector::create(c.triangles, c.frames[0], {culling}).value();
    EXPECT_TRUE(
        same(player_of(c, {culling}).play(0), by_hand.step(c.frames[0], c.frames[1], given)));
  }
  const auto from_point = player_of(c, {Culling::view_point}).play(0);
  const auto from_line = player_of(c, {Culling::view_line}).play(0);
  ASSERT_FALSE(from_point.primitives.empty());
  ASSERT_FALSE(from_line.primitives.empty());
  EXPECT_TRUE(same_ends(from_point.primitives[0], point));
  EXPECT_TRUE(same_ends(from_line.primitives[0], line));
}

TEST(CasePlayer, ALookOrAStopLeavesTheStateAlone) {
  const auto c = tests::curated_case("F_doubt_carried");
  const detector::Options options{Culling::view_point};
  auto played = player_of(c, options), looked = player_of(c, options);
  ASSERT_GE(played.steps(), 2u);
  EXPECT_TRUE(same(looked.look(0), played.play(0)));
  const auto goes_on = played.play(1), starts_anew = looked.look(1);
  EXPECT_FALSE(same(goes_on, starts_anew)) << "the state does not show in this case";
  EXPECT_TRUE(same(starts_anew, player_of(c, options).look(1)));
  looked.play(0);
  looked.look(0);
  EXPECT_TRUE(same(looked.play(1), goes_on));
  // So does a step that is stopped.
  auto stopped = player_of(c, options);
  EXPECT_EQ(stopped.play(0, [] { return true; }).answer, detector::Answer::undecided);
  EXPECT_TRUE(same(stopped.play(1), player_of(c, options).play(1)));
}

}  // namespace
}  // namespace assay::properties
