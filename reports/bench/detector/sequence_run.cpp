#include "reports/bench/detector/sequence_run.h"

#include <fmt/format.h>

#include "properties/judging/contracted_case.h"
#include "properties/judging/judged_run.h"
#include "properties/judging/step_errors.h"
#include "reports/bench/detector/timed_runs.h"
#include "reports/bench/interleave.h"

namespace assay::reports {
namespace {

using properties::Outcome;
using properties::RunEnd;

std::optional<ComparedTime> compared(const std::vector<double>& plugin,
                                     const std::vector<double>& built_in) {
  if (plugin.empty() || plugin.size() != built_in.size()) return std::nullopt;
  return ComparedTime{median_of(plugin), median_of(built_in), ratio_of(plugin, built_in)};
}

FirstTimesOff off(const properties::TimesOff& times) { return {times.steps, times.quantile(1)}; }

PluginErrors errors_of(const properties::JudgedRun& judged, std::size_t steps) {
  PluginErrors errors;
  for (const auto claim : judged.broken) errors.broken.emplace_back(name_of(claim));
  properties::StepErrors sum;
  for (const auto& diff : judged.steps) sum += properties::errors_of(diff);
  errors.judged = steps;
  errors.undecided = steps - sum.answered();
  errors.contact = sum.contact;
  errors.missed = sum.missed;
  errors.unsafe = sum.unsafe;
  errors.false_alarms = sum.false_alarms;
  errors.missing = sum.missing;
  errors.spurious = sum.spurious;
  errors.late = off(sum.late);
  errors.early = off(sum.early);
  return errors;
}

}  // namespace

ComparedWorkers::ComparedWorkers(const BenchedPlugin& plugin)
    : plugin_(plugin),
      of_plugin_(properties::worker_program(), plugin.library, plugin.limits),
      of_built_in_(properties::worker_program(), std::nullopt, {.seconds = plugin.limits.seconds}) {
}

ComparedSequence ComparedWorkers::compare(const SequenceToCompare& sequence,
                                          std::vector<std::string>& wrong,
                                          const std::function<void()>& tick) {
  const auto& contract = plugin_.description.contract;
  const auto& name = plugin_.description.name;
  const auto claims = claims_on_steps(plugin_.description);
  ComparedSequence out;
  out.name = sequence.c.id;
  out.kind = sequence.kind;
  out.triangles = static_cast<std::uint64_t>(sequence.c.triangles.rows());
  const auto planned = corpus::steps_of(sequence.c).size();
  const auto seen = properties::contracted(sequence.c, contract);
  out.steps = seen ? corpus::steps_of(*seen).size() : 0;
  out.left_out = planned - out.steps;
  if (!seen) {
    out.ended = "beyond the contract";
    return out;
  }
  // A plug-in that takes any start has to look at it, and then so does the built-in detector. A
  // gap in the sequence makes a new start, and nobody says that it is clean.
  const bool vouches = contract.start != properties::StartRule::any;
  const auto start = vouches && sequence.starts_clean && out.left_out == 0
                         ? detector::Start::clean
                         : detector::Start::verified;
  const auto pairs = claims.all_pairs ? detector::Pairs::all : detector::Pairs::first;
  const properties::Configuration own = {name, {}, {}, true};
  const properties::Configuration built_in = {
      "built-in", {detector::Options{}.culling, start, pairs}, {}, true};
  TimedRuns plugin_runs, built_in_runs;
  const auto measure = [&](auto& worker, const auto& configuration, TimedRuns& runs) {
    return [&] {
      tick();
      return runs.run_once(worker, *seen, configuration);
    };
  };
  interleave(sequence.rounds, {measure(of_plugin_, own, plugin_runs),
                               measure(of_built_in_, built_in, built_in_runs)});
  if (!built_in_runs.ended.empty())
    wrong.push_back(
        fmt::format("{}: the built-in detector's run {}", out.name, built_in_runs.ended));
  out.ended = plugin_runs.ended;
  if (out.ended.empty()) {
    out.step = compared(plugin_runs.ms_a_step, built_in_runs.ms_a_step);
    out.create = compared(plugin_runs.create_ms, built_in_runs.create_ms);
  }
  tick();
  const auto truth = properties::judge_case(*seen, contract, plugin_.jobs);
  const auto judged = judge_run(*seen, *plugin_runs.first, truth, claims, contract);
  out.errors = errors_of(judged, truth.size());
  if (claims.deterministic && plugin_runs.has_differing_runs)
    out.errors.broken.emplace_back(name_of(properties::Claim::deterministic));
  for (const auto& claim : out.errors.broken)
    wrong.push_back(fmt::format("{}: {} breaks {}", out.name, name, claim));
  const auto& answers = built_in_runs.first->steps;
  for (std::size_t s = 0; s < answers.size(); ++s) {
    const auto diff = properties::compare(answers[s], truth[s], built_in.options);
    if (diff.outcome == Outcome::holds) continue;
    wrong.push_back(fmt::format("{}, step {}: the built-in detector: {}", out.name, s + 1,
                                name_of(diff.outcome)));
  }
  return out;
}

}  // namespace assay::reports
