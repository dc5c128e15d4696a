#include "properties/faults/fault_run.h"

#include "detector/detector.h"

namespace assay::properties {
namespace {

using detector::Culling;
using detector::Detector;
using detector::StepResult;

std::vector<detector::ViewPrimitive> primitives_of(const corpus::Case& c, std::size_t step,
                                                   Culling culling) {
  const auto view = corpus::view_of_step(c, step);
  if (!view) return {};
  // A segment serves as a point by its first end.
  if (culling == Culling::view_point) return {{view->q0, view->q0}};
  if (culling == Culling::view_line) return {*view};
  return {};
}

}  // namespace

std::vector<StepResult> run_case(const corpus::Case& c, const detector::Options& options,
                                 const detector::Stages& stages) {
  const auto script = corpus::steps_of(c);
  auto made = Detector::assemble(c.triangles, c.frames.front(), options, stages);
  std::vector<StepResult> results(script.size());
  for (std::size_t s = 0; s < script.size(); ++s) {
    if (!made) {
      results[s].problem = made.error();
      continue;
    }
    const auto& x_t0 = c.frames[static_cast<std::size_t>(script[s].from)];
    const auto& x_t1 = c.frames[static_cast<std::size_t>(script[s].to)];
    const auto primitives = primitives_of(c, s, options.culling);
    results[s] = script[s].commit ? made.value().step(x_t0, x_t1, primitives)
                                  : made.value().evaluate(x_t0, x_t1, primitives);
  }
  return results;
}

std::vector<StepResult> run_case(const corpus::Case& c, const Fault& fault) {
  return run_case(c, fault.options, fault.stages(fault.options));
}

std::vector<StepResult> run_disturbed(const corpus::Case& c, const detector::Options& options,
                                      MakeStages stages) {
  constexpr int most_stops = 8;
  const auto script = corpus::steps_of(c);
  auto made = Detector::assemble(c.triangles, c.frames.front(), options, stages(options));
  auto beside = Detector::assemble(c.triangles, c.frames.front(), options, stages(options));
  std::vector<StepResult> results(script.size());
  for (std::size_t s = 0; s < script.size(); ++s) {
    if (!made || !beside) {
      results[s].problem = made.error();
      continue;
    }
    const auto& x_t0 = c.frames[static_cast<std::size_t>(script[s].from)];
    const auto& x_t1 = c.frames[static_cast<std::size_t>(script[s].to)];
    const auto primitives = primitives_of(c, s, options.culling);
    for (int stop_at = 1; stop_at <= most_stops; ++stop_at) {
      int asked = 0;
      const auto stop = [&] { return ++asked == stop_at; };
      const auto stopped = made.value().evaluate(x_t0, x_t1, primitives, stop);
      if (stopped.answer != detector::Answer::undecided) break;
    }
    const auto meanwhile = [&] {
      beside.value().evaluate(x_t0, x_t1, primitives);
      return false;
    };
    results[s] = script[s].commit ? made.value().step(x_t0, x_t1, primitives, meanwhile)
                                  : made.value().evaluate(x_t0, x_t1, primitives, meanwhile);
  }
  return results;
}

CaseRun without_marking_counts(std::vector<StepResult> results) {
  CaseRun run;
  run.steps = std::move(results);
  for (auto& step : run.steps) step.counts.marking = {};
  return run;
}

std::optional<StepDefect> first_defect(std::span<const StepResult> results,
                                       std::span<const oracle::StepJudgement> judgements,
                                       detector::Pairs claimed) {
  for (std::size_t s = 0; s < results.size(); ++s) {
    StepDefect defect{s, compare(results[s], judgements[s], claimed)};
    if (defect.diff.outcome != Outcome::holds) return defect;
  }
  return std::nullopt;
}

namespace {

std::optional<StepDefect> defect_of(const corpus::Case& c, const Fault& fault, MakeStages stages,
                                    std::span<const oracle::StepJudgement> judgements) {
  const auto results = run_case(c, fault.options, stages(fault.options));
  auto defect = first_defect(results, judgements, fault.options.pairs);
  if (defect || !fault.is_disturbed) return defect;
  const auto disturbed = run_disturbed(c, fault.options, stages);
  for (std::size_t s = 0; s < results.size(); ++s) {
    if (same_answers(without_marking_counts({results[s]}),
                     without_marking_counts({disturbed[s]}))) {
      continue;
    }
    StepDefect differs{s, {}};
    differs.diff.outcome = Outcome::defect;
    differs.diff.broken = {Claim::deterministic};
    return differs;
  }
  return std::nullopt;
}

}  // namespace

std::optional<StepDefect> first_defect(const corpus::Case& c, const Fault& fault,
                                       std::span<const oracle::StepJudgement> judgements) {
  return defect_of(c, fault, fault.stages, judgements);
}

std::optional<StepDefect> first_defect_without(const corpus::Case& c, const Fault& fault,
                                               std::span<const oracle::StepJudgement> judgements) {
  return defect_of(c, fault, detector::standard_stages, judgements);
}

}  // namespace assay::properties
