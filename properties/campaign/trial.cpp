#include "properties/campaign/trial.h"

#include <fmt/format.h>

#include "properties/case_check.h"

namespace assay::properties {

using detector::Culling;
using detector::Pairs;
using detector::Start;

Claims DetectorUnderTest::claims_in(const Configuration& configuration) const {
  return built_in ? claims_of(configuration.options.pairs) : claims;
}

DetectorUnderTest built_in_detector() {
  DetectorUnderTest detector;
  detector.name = "built-in";
  for (const auto culling :
       {Culling::view_point, Culling::view_line, Culling::bvh, Culling::none}) {
    detector.configurations.push_back({name_of(culling), {culling, Start::verified, Pairs::all}});
  }
  for (const auto culling : {Culling::view_point, Culling::view_line}) {
    detector.configurations.push_back(
        {fmt::format("{}/first", name_of(culling)), {culling, Start::verified, Pairs::first}});
  }
  return detector;
}

std::vector<oracle::StepJudgement> judge_steps(const corpus::Case& c, const Contract& contract) {
  std::vector<detector::Positions> frames;
  for (const auto& frame : c.frames) frames.push_back(contracted(frame, contract.coordinates));
  std::vector<oracle::StepJudgement> truth;
  for (const auto& step : corpus::steps_of(c)) {
    truth.push_back(oracle::judge_step(frames[static_cast<std::size_t>(step.from)],
                                       frames[static_cast<std::size_t>(step.to)], c.triangles,
                                       {1, {}}));
  }
  return truth;
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
      failure.stage = stage_that_lost(c.triangles, c.frames[static_cast<std::size_t>(step.from)],
                                      c.frames[static_cast<std::size_t>(step.to)], *failure.pair);
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

Verdict judge_run(const corpus::Case& c, const std::vector<oracle::StepJudgement>& truth,
                  const CaseRun& run, const Configuration& configuration,
                  const DetectorUnderTest& detector) {
  const Claims claims = detector.claims_in(configuration);
  Verdict verdict;
  const auto ended_without_answer = [&](const char* kind) {
    verdict.outcome = claims.total ? Outcome::defect : Outcome::error;
    Failure failure;
    failure.kind = kind;
    failure.configuration = configuration.name;
    failure.what = run.what;
    verdict.failure = std::move(failure);
    return verdict;
  };
  switch (run.end) {
    case RunEnd::crashed:
      return ended_without_answer("crash");
    case RunEnd::refused:
      return ended_without_answer("refused");
    case RunEnd::hung:
    case RunEnd::out_of_memory:
      verdict.outcome = Outcome::undecided;
      return verdict;
    case RunEnd::not_run:
      verdict.outcome = Outcome::error;
      return verdict;
    case RunEnd::completed:
      break;
  }
  const auto steps = corpus::steps_of(c);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const StepDiff diff =
        detector.built_in ? compare(run.steps[s], truth[s], configuration.options.pairs)
                          : compare(run.steps[s], truth[s], claims, detector.contract, c.triangles);
    if (diff.outcome == Outcome::holds) continue;
    verdict.outcome = diff.outcome;
    if (diff.outcome == Outcome::defect) {
      verdict.failure = failure_of_step(c, steps[s], diff, detector);
      verdict.failure->step = s;
      verdict.failure->configuration = configuration.name;
    }
    return verdict;
  }
  return verdict;
}

}  // namespace assay::properties
