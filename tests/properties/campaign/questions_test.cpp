// What the built-in detector is asked besides contacts, each question in a stratum of its own: how
// far a step may be gone, and what comes within a distance. A wrong answer is found there.
#include "detector/distance/nearness.h"
#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/phases/shrink.h"
#include "properties/campaign/trials/planned_case.h"
#include "properties/judging/case_options.h"
#include "properties/queries/query_families.h"
#include "properties/worker/case_run.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using tests::Scratch;

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
    const auto c = case_within(detector.contract, *find_family(question), id).seen;
    if (!c) continue;
    found.failure = judge_trial(*c, judge_case(*c, detector.contract), run(*c, configuration),
                                configuration, detector)
                        .failure;
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
  EXPECT_NE(found.failure->explanation.find("come within 0.015625"), std::string::npos)
      << found.failure->explanation;
}

CampaignRequest both_questions(std::uint64_t cases) {
  auto request = test::request_of(cases, 2);
  request.plan.strata = {{"limits", cases, 0}, {"broken", 2, 0}, {"within", cases, 0}};
  return request;
}

TEST(Questions, EachIsAskedInItsStratumAlone) {
  const Scratch scratch;
  auto store = Store::open(scratch / "store", "b");
  const auto request = both_questions(40);
  ASSERT_TRUE(run_trials(request, store.value(), test::in_ten_minutes(), {}).complete);
  Tally tally;
  store.value().for_each_trial([&](const TrialRecord& r) {
    EXPECT_EQ(r.outcomes.size(), r.family == "broken" ? 10u : 1u) << r.outcomes;
    EXPECT_EQ(r.outcomes.find_first_not_of('H'), std::string::npos) << r.id << r.outcomes;
    tally.add(r);
  });
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
  auto store = Store::open(scratch / "store", "b");
  auto request = both_questions(20);
  request.plan.strata.erase(request.plan.strata.begin() + 1);
  for (auto& configuration : request.detector.of_questions)
    configuration.fault = "elementary/only-vertex-face";
  ASSERT_TRUE(run_trials(request, store.value(), test::in_ten_minutes(), {}).complete);
  shrink_failures(request, store.value(), {5, 2000}, test::in_ten_minutes(), {});
  std::set<std::string> found;
  for (const auto& failure : store.value().failures()) {
    if (failure.smallest.empty()) continue;
    found.insert(failure.configuration);
    const auto c = corpus::parse_case(failure.smallest, failure.id);
    ASSERT_TRUE(c);
    auto asked = read_configuration(c.value(), failure.configuration);
    ASSERT_TRUE(asked);
    EXPECT_TRUE(asked.value().asks_limits);
    EXPECT_EQ(asked.value().options.separation, failure.configuration == "within" ? 0x1p-6 : 0);
    asked.value().fault = "elementary/only-vertex-face";
    const auto detector = request.detector.in(asked.value());
    WorkerProcess worker(request.worker, std::nullopt);
    const auto finding = judge_of_detector(detector, asked.value(), worker)(c.value());
    ASSERT_TRUE(finding) << failure.signature;
    EXPECT_EQ(finding->signature, failure.signature);
  }
  EXPECT_EQ(found, (std::set<std::string>{"limits", "within"}));
}

}  // namespace
}  // namespace assay::properties
