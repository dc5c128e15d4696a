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

std::optional<StepDefect> first_defect(std::span<const StepResult> results,
                                       std::span<const oracle::StepJudgement> judgements,
                                       detector::Pairs claimed) {
  for (std::size_t s = 0; s < results.size(); ++s) {
    StepDefect defect{s, compare(results[s], judgements[s], claimed)};
    if (defect.diff.outcome != Outcome::holds) return defect;
  }
  return std::nullopt;
}

std::optional<StepDefect> first_defect(const corpus::Case& c, const Fault& fault,
                                       std::span<const oracle::StepJudgement> judgements) {
  return first_defect(run_case(c, fault), judgements, fault.options.pairs);
}

std::optional<StepDefect> first_defect_without(const corpus::Case& c, const Fault& fault,
                                               std::span<const oracle::StepJudgement> judgements) {
  const auto right = detector::standard_stages(fault.options);
  return first_defect(run_case(c, fault.options, right), judgements, fault.options.pairs);
}

}  // namespace assay::properties
