#include "properties/judging/fault_run.h"

#include <algorithm>

namespace assay::properties {
namespace {

using detector::StepResult;

std::vector<StepResult> refused(const corpus::Case& c, const detector::Problem& problem) {
  StepResult result;
  result.problem = problem;
  return std::vector<StepResult>(corpus::steps_of(c).size(), result);
}

}  // namespace

std::vector<StepResult> run_case(const corpus::Case& c, const detector::Options& options,
                                 const detector::Stages& stages) {
  auto player = CasePlayer::make(c, options, stages);
  if (!player) return refused(c, player.error());
  std::vector<StepResult> results;
  for (std::size_t s = 0; s < player.value().steps(); ++s) {
    results.push_back(player.value().play(s));
  }
  return results;
}

std::vector<StepResult> run_case(const corpus::Case& c, const Fault& fault) {
  return run_case(c, fault.options, fault.stages(fault.options));
}

std::vector<StepResult> run_disturbed(const corpus::Case& c, const detector::Options& options,
                                      MakeStages stages, std::span<const StepResult> undisturbed) {
  constexpr int most_stops = 8;
  auto made = CasePlayer::make(c, options, stages(options));
  auto beside = CasePlayer::make(c, options, stages(options));
  if (!made || !beside) return refused(c, made.error());
  std::vector<StepResult> results;
  for (std::size_t s = 0; s < made.value().steps(); ++s) {
    std::vector<StepResult> after_stops;
    for (int stop_at = 1; stop_at <= most_stops; ++stop_at) {
      int asked = 0;
      const auto stop = [&] { return ++asked == stop_at; };
      const auto stopped = made.value().look(s, stop);
      if (stopped.answer != detector::Answer::undecided) break;
      after_stops.push_back(made.value().look(s));
    }
    const auto meanwhile = [&] {
      beside.value().look(s);
      return false;
    };
    results.push_back(made.value().play(s, meanwhile));
    const auto differs = [&](const StepResult& disturbed) {
      return !same_answers(without_marking_counts({disturbed}),
                           without_marking_counts({undisturbed[s]}));
    };
    const auto other = std::find_if(after_stops.begin(), after_stops.end(), differs);
    if (other != after_stops.end() && !differs(results.back())) results.back() = *other;
  }
  return results;
}

CaseRun without_marking_counts(std::vector<StepResult> results) {
  CaseRun run;
  run.steps = std::move(results);
  for (auto& step : run.steps) step.counts.marking = {};
  return run;
}

}  // namespace assay::properties
