// Questions other than contacts to the built-in detector, each in a stratum of its own: how far a
// step can go, and which pairs come within a distance. Wrong answers to these questions are found.
#include "detector/distance/nearness.h"
#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/trials/trials.h"
#include "properties/generators/families.h"
#include "properties/judging/case_options.h"
#include "properties/judging/exam.h"
#include "properties/queries/query_families.h"
#include "properties/worker/case_run.h"
#include "tests/curated_cases.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/properties/small_case.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using tests::curated_case, tests::Scratch;

// The first of 200 cases of the stratum in which the detector fails, as smoke has it.
struct Found {
  std::uint64_t after = 0;
  std::optional<Failure> failure;
};
template <class Run>
Found first_failure(const std::string& question, const Run& run) {
  const auto detector = built_in_detector().in_stratum(question);
  const auto& configuration = detector.configurations.front();
  EXPECT_EQ(detector.configurations.size(), 1u);
  Found found;
  while (found.after < 200 && !found.failure) {
    const auto id = "smoke:1:" + question + ":" + std::to_string(found.after++);
    const auto c = case_within(detector.contract, *find_family(question), id).input;
    if (!c) continue;
    found.failure =
        test::verdict_on(*c, {}, run(*c, configuration), configuration, detector).failure;
  }
  return found;
}

TEST(Questions, L17_ALimitThatIsTheTimeOfTheContactIsFound) {
  const auto found = first_failure("limits", [](const corpus::Case& c, const auto& configuration) {
    CaseRun run = run_case(c, configuration);
    const auto steps = corpus::steps_of(c);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const auto& [from, to] = std::tie(start_of(c, steps[s]), end_of(c, steps[s]));
      const auto& result = run.steps[s];
      if (result.answer != detector::Answer::collision || result.first.hi == 0) continue;
      run.limits[s] = {result.first.lo, from + result.first.lo * (to - from)};
    }
    return run;
  });
  ASSERT_TRUE(found.failure);
  EXPECT_LT(found.after, 20u);
  EXPECT_TRUE(claims_on_limits.has(found.failure->claim)) << found.failure->signature();
}

// Of what comes within the distance it sees what is so at an end of the step.
struct NearAtEndsAlone : detector::ElementaryTest {
  explicit NearAtEndsAlone(double d) : d_(d) {}
  double separation() const override { return d_; }
  detector::ContactResult test(const detector::FourPoints& query,
                               detector::Want want) const override {
    for (const auto end : {&detector::MovingPoint::t0, &detector::MovingPoint::t1}) {
      auto still = query;
      for (auto& point : still.points) point.t0 = point.t1 = point.*end;
      if (test_near(still, d_, want).contact) return test_near(query, d_, want);
    }
    return {};
  }
  double d_;
};

TEST(Questions, L16_ADistanceOfTheEndsAloneIsFound) {
  const auto found = first_failure("within", [](const corpus::Case& c, const auto& configuration) {
    auto stages = detector::standard_stages(configuration.options);
    stages.elementary = std::make_shared<NearAtEndsAlone>(configuration.options.separation);
    auto player = CasePlayer::make(c, configuration.options, stages);
    CaseRun run;
    for (std::size_t s = 0; s < player.value().steps(); ++s) {
      const auto limit =
          player.value().detector().limit(player.value().x_t0(s), player.value().x_t1(s));
      run.limits.push_back(LimitAnswer{limit.share, limit.positions});
      run.steps.push_back(player.value().play(s));
    }
    return run;
  });
  ASSERT_TRUE(found.failure);
  EXPECT_LT(found.after, 50u);
  EXPECT_TRUE(says(found.failure->explanation, "come within 0.015625"));
}

CampaignRequest both_questions(std::uint64_t cases) {
  auto request = test::request_of(cases, 2);
  request.plan.strata = {{"limits", cases, 0}, {"broken", 2, 0}, {"within", cases, 0}};
  return request;
}

TEST(Questions, EachIsAskedInItsStratumAlone) {
  const Scratch scratch;
  const auto store = test::with_all_trials(both_questions(40), scratch / "store");
  store.for_each_trial([&](const TrialRecord& r) {
    EXPECT_EQ(r.outcomes, std::string(r.family == "broken" ? 10 : 1, 'H')) << r.id;
  });
  auto tally = test::tally_in(store);
  for (const std::string question : {"limits", "within"}) {
    const auto& stratum = tally.strata[question];
    EXPECT_EQ(stratum.trials, 40u);
    EXPECT_GT(stratum.meshes.size(), 35u);
    EXPECT_GT(stratum.measures.contact_trials, 10u) << question;
  }
}

// A fault is planted in the worker; what fails there is stored, shrunk and replayed as it was
// asked.
TEST(Questions, WhatFailsIsKeptWithItsQuestion) {
  const Scratch scratch;
  auto request = both_questions(20);
  request.plan.strata.erase(request.plan.strata.begin() + 1);
  for (auto& configuration : request.detector.of_questions)
    configuration.fault = "elementary/only-vertex-face";
  auto store = test::with_all_trials(request, scratch / "store");
  shrink_failures(request, store, {5, 2000}, test::in_ten_minutes(), {});
  std::set<std::string> found;
  for (const auto& failure : store.failures()) {
    if (failure.smallest.empty()) continue;
    found.insert(failure.configuration);
    const auto c = corpus::parse_case(failure.smallest, failure.id());
    ASSERT_TRUE(c);
    auto asked = read_configuration(c.value(), failure.configuration);
    ASSERT_TRUE(asked);
    EXPECT_TRUE(asked.value().asks_limits);
    EXPECT_EQ(asked.value().options.separation, failure.configuration == "within" ? 0x1p-6 : 0);
    asked.value().fault = "elementary/only-vertex-face";
    const auto detector = request.detector.in(asked.value());
    WorkerProcess worker(request.worker, std::nullopt);
    const auto finding = judge_of_detector(detector, asked.value(), worker)(c.value());
    ASSERT_TRUE(finding) << failure.signature();
    EXPECT_EQ(finding->signature, failure.signature());
  }
  EXPECT_EQ(found, (std::set<std::string>{"limits", "within"}));
}

// A fault that this curated case shows with its start verified.
const char* const faulty_on_this_case = "state/start-contacts-not-checked";

TEST(CleanStarts, OfBodiesThatNothingTouchesOrWrapsTwice) {
  const std::pair<const char*, bool> cases[] = {
      {"C1_lost_plus_plus", true},  // in contact later
      {"C3_skip_adjacent", true},
      {"A2_nested_outward", true},  // layers count the own component
      {"C5_start_intersecting", false},
      {"A1_winding2_allpositive", false},
      // Ghosts are part of the surface, so what they touch is not clean.
      {"D8_release_arm_sequence", true},
      {"X_rim_at_the_largest_double", true},
      {"F_pierced_ghost", false}};
  for (const auto& [name, is_clean] : cases)
    EXPECT_EQ(starts_clean(curated_case(name)), is_clean) << name;
}

// Every new start counts: a step that begins elsewhere than the last commit ended.
TEST(CleanStarts, OfEveryNewStart) {
  corpus::Case c = curated_case("C1_lost_plus_plus");
  const detector::Positions clean = c.frames[0];
  detector::Positions folded = clean;
  folded.row(5) = folded.row(4);
  c.frames = {clean, clean, folded, folded};
  c.script = {{0, 1, true}, {1, 2, true}};
  EXPECT_TRUE(starts_clean(c));
  c.script = {{0, 1, true}, {3, 2, true}};
  EXPECT_FALSE(starts_clean(c));
  // The second one starts where the first ended, in another frame of the same places.
  c.script = {{0, 2, true}, {3, 3, true}};
  EXPECT_TRUE(starts_clean(c));
  // Not committed: the state is still that of no start.
  c.script = {{0, 2, false}, {3, 3, true}};
  EXPECT_FALSE(starts_clean(c));
}

TEST(CleanStarts, AreVouchedForInEverySecondTrialOfTheBuiltIn) {
  const auto clean = curated_case("C1_lost_plus_plus"),
             intersecting = curated_case("C5_start_intersecting");
  const auto built_in = built_in_detector();
  for (const std::uint64_t index : {1u, 3u, 1001u}) {
    EXPECT_TRUE(is_vouched_for(built_in, clean, index)) << index;
    EXPECT_FALSE(is_vouched_for(built_in, clean, index - 1)) << index;
    EXPECT_FALSE(is_vouched_for(built_in, intersecting, index)) << index;
  }
  auto plugin = built_in;
  plugin.built_in = false;
  EXPECT_FALSE(is_vouched_for(plugin, clean, 1));
  // Only verified ones are.
  using detector::Culling, detector::Start;
  const auto changed = with_clean_start(
      {{"a", {Culling::bvh, Start::verified}}, {"b", {Culling::bvh, Start::unknown}}});
  EXPECT_EQ(changed[0].options.start, Start::clean);
  EXPECT_EQ(changed[1].options.start, Start::unknown);
}

// A detector that trusts what is not so misses contacts: that is no fault of its own, so there is
// nothing to shrink, whatever else is wrong with it.
TEST(CleanStarts, VouchedForWronglyBlameNobody) {
  const auto c = curated_case("C5_start_intersecting");
  const auto finding = [&](detector::Start start, const std::string& fault) {
    const Configuration configuration{"told", {detector::Culling::view_point, start}, fault};
    auto detector = built_in_detector();
    detector.configurations = {configuration};
    WorkerProcess worker(ASSAY_WORKER, std::nullopt);
    return judge_of_detector(detector, configuration, worker)(c);
  };
  EXPECT_FALSE(finding(detector::Start::verified, ""));
  EXPECT_TRUE(finding(detector::Start::verified, faulty_on_this_case));
  EXPECT_FALSE(finding(detector::Start::clean, ""));
  EXPECT_FALSE(finding(detector::Start::clean, faulty_on_this_case));
  // It does answer wrongly.
  const Configuration trusting{"told", {detector::Culling::view_point, detector::Start::clean}};
  EXPECT_EQ(examine({built_in_detector(), {&trusting, 1}}, c).verdicts[0].outcome, Outcome::defect);
}

}  // namespace
}  // namespace assay::properties
