// Verdicts on hand-made runs of a case.
#include "properties/campaign/trials/trials.h"
#include "properties/judging/case_options.h"
#include "properties/judging/cause.h"
#include "properties/judging/exam.h"
#include "tests/properties/small_case.h"
#include "tests/sinking_corner.h"

namespace assay::properties {
namespace {

using detector::Answer, detector::Culling, detector::Pairs, detector::Start;

class JudgedTrials : public testing::Test {
 protected:
  JudgedTrials() {
    for (std::uint64_t i = 0; truth.empty() || truth[0].pairs.size() < 2; ++i) {
      c = test::small_case(7, i);
      truth = judge_case(c);
    }
    right = run_case(c, configuration);
    plugin.name = "plug-in";
    plugin.built_in = false;
    plugin.claims = claims_of({});
    plugin.configurations = {configuration};
  }
  Verdict judge(const CaseRun& run, const DetectorUnderTest& detector,
                const CaseRun* again = nullptr) const {
    return test::verdict_on(c, truth, run, configuration, detector, again);
  }
  static CaseRun ended(RunEnd end, const std::string& explanation) {
    return {end, explanation, {}};
  }
  void expect_failure(const CaseRun& run, const DetectorUnderTest& detector, Claim claim,
                      const std::string& signature) const {
    const auto judged = judge(run, detector);
    EXPECT_EQ(judged.outcome, Outcome::defect);
    ASSERT_TRUE(judged.failure);
    EXPECT_EQ(judged.failure->claim, claim) << name_of(judged.failure->claim);
    EXPECT_EQ(judged.failure->signature(), signature + cause_behind(judged, detector));
    EXPECT_EQ(judged.failure->configuration, "bvh");
    EXPECT_EQ(judged.failure->step, 0u);
    EXPECT_FALSE(judged.failure->explanation.empty());
    EXPECT_EQ(judged.failure->explanation.find('\n'), std::string::npos);
  }
  // What the signature of a plug-in's step ends with.
  std::string cause_behind(const Verdict& judged, const DetectorUnderTest& detector) const {
    if (detector.built_in || !judged.failure->pair) return "";
    const auto contact =
        std::find_if(truth[0].pairs.begin(), truth[0].pairs.end(),
                     [&](const auto& exact) { return exact.pair == *judged.failure->pair; });
    return ", " + cause_of(c.triangles, {c.frames[0], c.frames[1]}, *contact);
  }
  std::string feature_of_first() const { return name_of(truth[0].pairs[0].feature.kind); }

  corpus::Case c;
  std::vector<oracle::StepJudgement> truth;
  CaseRun right;
  Configuration configuration{"bvh", {Culling::bvh, Start::verified, Pairs::all}};
  DetectorUnderTest built_in = built_in_detector(), plugin;
};

TEST_F(JudgedTrials, ARightRunHolds) {
  for (const auto* detector : {&built_in, &plugin}) {
    const auto judged = judge(right, *detector, &right);
    EXPECT_EQ(judged.outcome, Outcome::holds);
    EXPECT_FALSE(judged.failure);
  }
}

// A detector may not choose which steps of a case speak for it.
TEST_F(JudgedTrials, ACaseWithARefusedStepSpeaksForNothing) {
  c.frames.push_back(c.frames[0]);
  c.script = {{0, 1, true}, {0, 1, true}};
  truth = judge_case(c);
  auto run = run_case(c, configuration);
  plugin.contract.capacity_triangles = 1;
  EXPECT_EQ(judge(run, plugin).outcome, Outcome::holds);
  run.steps[1] = {};
  run.steps[1].answer = Answer::error;
  note_capacity(run, 1);
  EXPECT_EQ(judge(run, plugin).outcome, Outcome::refused);
  // A wrong step is a defect beside a refused one.
  run.steps[0] = {};
  run.steps[0].answer = Answer::free;
  EXPECT_EQ(judge(run, plugin).outcome, Outcome::defect);
}

TEST_F(JudgedTrials, ACrashBreaksTotal) {
  const auto crash = ended(RunEnd::crashed, "killed by signal 11 (Segmentation fault)");
  for (const auto* detector : {&built_in, &plugin}) {
    expect_failure(crash, *detector, Claim::total, "total: crashed");
    EXPECT_EQ(judge(crash, *detector).failure->explanation, crash.explanation);
  }
  plugin.claims.set(Claim::total, false);
  EXPECT_EQ(judge(crash, plugin).outcome, Outcome::error);
  EXPECT_FALSE(judge(crash, plugin).failure);
}

TEST_F(JudgedTrials, ARefusalOfAValidMeshBreaksTotal) {
  expect_failure(ended(RunEnd::refused, "too many"), plugin, Claim::total, "total: refused");
  c.expected.answer = Answer::error;
  EXPECT_EQ(judge(ended(RunEnd::refused, "as it must"), plugin).outcome, Outcome::holds);
}

TEST_F(JudgedTrials, AHangIsUndecided) {
  for (const auto end : {RunEnd::hung, RunEnd::out_of_memory}) {
    EXPECT_EQ(judge(ended(end, "no answer in 10 s"), plugin).outcome, Outcome::undecided);
    EXPECT_FALSE(judge(ended(end, "no answer in 10 s"), built_in).failure);
  }
  EXPECT_EQ(judge(ended(RunEnd::not_run, "no worker"), plugin).outcome, Outcome::error);
}

TEST_F(JudgedTrials, AMissingPairAndFreeAgainstAContact) {
  auto wrong = right;
  wrong.steps[0].pairs.erase(wrong.steps[0].pairs.begin());
  // The stage is found by running the built-in again, which has no fault here: the last one.
  expect_failure(
      wrong, built_in, Claim::all_pairs,
      "all-pairs: missing pair at " +
          stage_that_lost(c.triangles, c.frames[0], c.frames[1], truth[0].pairs[0].pair) + ", " +
          feature_of_first());
  const auto failure = *judge(wrong, plugin).failure;
  expect_failure(wrong, plugin, failure.claim,
                 std::string(name_of(failure.claim)) + ": missing pair, " + feature_of_first());
  EXPECT_EQ(failure.pair, truth[0].pairs[0].pair);
  wrong.steps[0].answer = Answer::free;
  wrong.steps[0].pairs.clear();
  expect_failure(wrong, plugin, Claim::free_sound,
                 "free-sound: answered free, " + feature_of_first());
}

TEST_F(JudgedTrials, ALatePair) {
  auto wrong = right;
  auto& contact = wrong.steps[0].pairs[0];
  if (contact.time.hi == 1) GTEST_FAIL() << "choose a case whose first pair meets before t = 1";
  contact.time = {1, 1};
  const auto failure = judge(wrong, built_in).failure;
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, failure->claim == Claim::all_pairs ? "late pair" : "late");
  EXPECT_EQ(failure->pair, contact.pair);
  EXPECT_TRUE(says(failure->explanation, "exact"));
  EXPECT_TRUE(failure->signature().starts_with(std::string(name_of(failure->claim)) + ": late"));
}

TEST_F(JudgedTrials, ASpuriousPair) {
  for (std::uint64_t i = 0; !truth[0].pairs.empty() || c.triangles.rows() < 2; ++i) {
    c = test::small_case(9, i);
    truth = judge_case(c);
  }
  auto wrong = run_case(c, configuration);
  ASSERT_EQ(judge(wrong, plugin).outcome, Outcome::holds);
  wrong.steps[0].answer = Answer::collision;
  wrong.steps[0].first = {0, 1};
  wrong.steps[0].pairs = {{{0, 1}, {0, 1}, {}}};
  const auto failure = judge(wrong, plugin).failure;
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, "answered collision");
  EXPECT_EQ(failure->pair, (detector::TrianglePair{0, 1}));
}

// A failure names what was asked of the triangles.
TEST_F(JudgedTrials, UnderASeparation) {
  plugin.contract = {.adjacency = Adjacency::no_shared_vertex, .separation = 2};
  const auto told = [&](const CaseRun& run) {
    truth = judge_case(c, plugin.contract);
    const auto failure = judge(run, plugin).failure;
    return failure ? failure->explanation : "";
  };
  CaseRun run;
  run.steps.resize(1);
  run.steps[0].answer = Answer::free;
  c = tests::sinking_corner(1);
  EXPECT_EQ(told(run),
            "triangles 0 and 1 come within 2 at t = 0.5 (vertex-face); answered free, exact "
            "collision at 0.5");
  c = tests::sinking_corner(2.75);
  run.steps[0].answer = Answer::collision;
  const std::string answered = "; answered collision at [0, 1], exact free";
  run.steps[0].first = {0, 1};
  EXPECT_EQ(told(run), "no two triangles come within 2" + answered);
  run.steps[0].pairs = {{{0, 1}, {0, 1}, {}}};
  EXPECT_EQ(told(run), "triangles 0 and 1 do not come within 2" + answered);
  plugin.contract.margin = 0.5;
  EXPECT_EQ(told(run), "triangles 0 and 1 do not come within 2 + 0.5" + answered);
}

// The stage that lost a pair is that of a detector which is asked the same.
TEST_F(JudgedTrials, TheStageUnderASeparation) {
  configuration.options.separation = 2;
  c = tests::sinking_corner(1);
  built_in = built_in.in(configuration);
  truth = judge_case(c, built_in.contract);
  auto wrong = run_case(c, configuration);
  ASSERT_EQ(judge(wrong, built_in).outcome, Outcome::holds);
  wrong.steps[0].pairs.clear();
  const auto failure = judge(wrong, built_in).failure;
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->stage, "view sets");
}

TEST_F(JudgedTrials, TwoRunsThatDiffer) {
  auto other = right;
  ++other.steps[0].counts.closure_rounds;
  ASSERT_FALSE(same_answers(right, other));
  const auto judged = judge(right, plugin, &other);
  EXPECT_EQ(judged.outcome, Outcome::defect);
  ASSERT_TRUE(judged.failure);
  EXPECT_EQ(judged.failure->signature(), "deterministic: two runs differ");
  plugin.claims.set(Claim::deterministic, false);
  EXPECT_EQ(judge(right, plugin, &other).outcome, Outcome::holds);
}

TEST_F(JudgedTrials, TheCaseOfAFailureSaysWhatItIs) {
  c.id = "test:1:broken:7";
  auto wrong = right;
  wrong.steps[0].pairs.erase(wrong.steps[0].pairs.begin());
  const auto failure = judge(wrong, built_in).failure;
  ASSERT_TRUE(failure);
  const auto failing = failing_case(c, configuration, built_in, *failure);
  EXPECT_EQ(failing.id, "test-1-broken-7");
  EXPECT_EQ(failing.source, "campaign case test:1:broken:7, detector built-in, bvh");
  EXPECT_TRUE(says(failing.about, failure->signature()));
  EXPECT_EQ(options_of(failing).culling, Culling::bvh);
  EXPECT_EQ(options_of(failing).pairs, Pairs::all);
  const auto again = corpus::parse_case(corpus::case_text(failing), "again");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again.value().frames, c.frames);
  EXPECT_EQ(again.value().triangles, c.triangles);
  EXPECT_TRUE(failing_case(c, configuration, plugin, *failure).options.empty());
}

}  // namespace
}  // namespace assay::properties
