#include "properties/campaign/phases/trial.h"

#include <fmt/format.h>

#include "properties/judging/case_check.h"

namespace assay::properties {

using detector::Culling;
using detector::Pairs;
using detector::Start;

Claims DetectorUnderTest::claims_in(const Configuration& configuration) const {
  return built_in ? claims_of(configuration.options) : claims;
}

DetectorUnderTest built_in_detector() {
  DetectorUnderTest detector;
  detector.name = "built-in";
  for (const auto culling : {Culling::view_auto, Culling::view_point, Culling::view_line,
                             Culling::normal_cone, Culling::bvh, Culling::none}) {
    detector.configurations.push_back({name_of(culling), {culling, Start::verified, Pairs::all}});
  }
  // With first pairs a step ends with K, which is the same for lines.
  detector.configurations.push_back(
      {"view-point/first", {Culling::view_point, Start::verified, Pairs::first}});
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    detector.configurations.push_back(
        {fmt::format("{}/bounded", name_of(culling)),
         {culling, Start::verified, Pairs::all, detector::Arithmetic::bounded}});
  }
  return detector;
}

std::string Failure::signature() const {
  return fmt::format("{}: {}{}{}", name_of(claim), kind,
                     stage.empty() ? "" : fmt::format(" at {}", stage),
                     feature.empty() ? "" : fmt::format(", {}", feature));
}

namespace {

std::string time_text(const detector::TimeEnclosure& t) {
  return t.lo == t.hi ? fmt::format("{}", t.lo) : fmt::format("({}, {})", t.lo, t.hi);
}

Failure failure_of_step(const corpus::Case& c, const corpus::CaseStep& step, const StepDiff& diff,
                        const DetectorUnderTest& detector) {
  Failure failure;
  failure.claim = diff.broken.front();
  const auto about = [&](const char* kind, const detector::PairContact& contact) {
    failure.kind = kind;
    failure.pair = contact.pair;
    failure.feature = name_of(contact.feature.kind);
    failure.what = fmt::format("triangles {} and {} ({}, t = {})", contact.pair.a, contact.pair.b,
                               failure.feature, time_text(contact.time));
  };
  const auto about_time = [&](const char* kind, const WrongTime& wrong) {
    failure.kind = kind;
    failure.pair = wrong.pair;
    failure.what = fmt::format("triangles {} and {} at {}, oracle {}", wrong.pair.a, wrong.pair.b,
                               time_text(wrong.detector), time_text(wrong.oracle));
  };
  if (!diff.missing.empty()) {
    about("missing", diff.missing.front());
    if (detector.built_in) {
      failure.stage =
          stage_that_lost(c.triangles, start_of(c, step), end_of(c, step), *failure.pair);
    }
  } else if (!diff.spurious.empty()) {
    about("spurious", diff.spurious.front());
  } else if (!diff.late.empty()) {
    about_time("late", diff.late.front());
  } else if (!diff.early.empty()) {
    about_time("early", diff.early.front());
  } else {
    failure.kind = diff.wrong_answer ? "answer" : diff.wrong_first_time ? "first time" : "error";
    failure.what = failure.kind + " is wrong";
  }
  return failure;
}

}  // namespace

Verdict judge_trial(const corpus::Case& c, std::span<const oracle::StepJudgement> truth,
                    const CaseRun& run, const Configuration& configuration,
                    const DetectorUnderTest& detector, const CaseRun* again) {
  const Claims claims = detector.claims_in(configuration);
  // The built-in detector's steps are judged more strictly below.
  const auto by_claims = detector.built_in ? std::span<const oracle::StepJudgement>{} : truth;
  RunVerdict whole = judge_run(c, run, by_claims, claims, detector.contract, again);
  if (detector.built_in) {
    for (std::size_t s = 0; s < run.steps.size(); ++s) {
      whole.steps.push_back(compare(run.steps[s], truth[s], configuration.options));
    }
  }
  Verdict verdict{whole.outcome, {}, whole.left_out_misses};
  const auto steps = corpus::steps_of(c);
  for (std::size_t s = 0; s < whole.steps.size() && !verdict.failure; ++s) {
    const StepDiff& diff = whole.steps[s];
    if (diff.outcome == Outcome::defect) {
      verdict.outcome = Outcome::defect;
      verdict.failure = failure_of_step(c, steps[s], diff, detector);
      verdict.failure->step = s;
    } else if (diff.outcome != Outcome::holds && verdict.outcome == Outcome::holds) {
      verdict.outcome = diff.outcome;
    }
  }
  if (verdict.outcome == Outcome::defect && !verdict.failure) {
    verdict.failure.emplace();
    verdict.failure->claim = whole.broken.front();
    verdict.failure->kind =
        whole.broken.front() == Claim::deterministic ? "two runs differ" : name_of(run.end);
    verdict.failure->what = whole.what.empty() ? verdict.failure->kind : whole.what;
  }
  if (verdict.failure) verdict.failure->configuration = configuration.name;
  return verdict;
}

}  // namespace assay::properties
