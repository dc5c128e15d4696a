#include "reports/bench/workers/detector_suite.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/ledger/binding.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/judged_run.h"
#include "reports/bench/cases.h"
#include "reports/bench/sweep.h"
#include "reports/check/detector_choice.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using properties::Outcome;

std::optional<ComparedTime> compared(const std::vector<double>& plugin,
                                     const std::vector<double>& built_in) {
  if (plugin.empty() || plugin.size() != built_in.size()) return std::nullopt;
  return ComparedTime{median_of(plugin), median_of(built_in), ratio_of(plugin, built_in)};
}

// One worker for each of the two detectors, kept from sequence to sequence.
class ComparedWorkers {
 public:
  ComparedWorkers(const properties::Subject& plugin, int jobs)
      : plugin_(plugin),
        claims_(plugin.detector.claims),
        jobs_(jobs),
        of_plugin_(plugin.process()),
        of_built_in_(plugin.worker, std::nullopt, {.seconds = plugin.limits.seconds}) {}

  // Adds a line to `wrong` for a broken claim of the plug-in, for two runs that differ although it
  // claims to be deterministic, and for anything that the built-in detector has wrong. `tick` is
  // called between runs.
  ComparedSequence compare(const TimedCase& timed, const CaseFamily& family,
                           std::vector<std::string>& wrong, const std::function<void()>& tick) {
    ComparedSequence out;
    out.name = family.name;
    out.kind = family.kind;
    out.triangles = static_cast<std::uint64_t>(timed.c.triangles.rows());
    const auto& contract = plugin_.detector.contract;
    const auto seen = properties::contracted(timed.c, contract);
    out.steps = seen ? corpus::steps_of(*seen).size() : 0;
    out.left_out = corpus::steps_of(timed.c).size() - out.steps;
    if (!seen) {
      out.ended = "beyond the contract";
      return out;
    }
    // A plug-in that takes any start has to look at it, and then so does the built-in detector. A
    // gap in the sequence makes a new start, and nobody says that it is clean.
    const bool vouches = contract.start != properties::StartRule::any && out.left_out == 0;
    const auto start = vouches ? timed.start : detector::Start::verified;
    const auto pairs =
        claims_.has(properties::Claim::all_pairs) ? detector::Pairs::all : detector::Pairs::first;
    detector::Options options = {detector::Options{}.culling, start, pairs};
    if (contract.separation > 0) options.culling = detector::Culling::bvh;
    options.separation = contract.separation;
    const WorkerSubject subjects[] = {{&of_plugin_, {plugin_.description.name, {}, {}, true}},
                                      {&of_built_in_, {"built-in", options, {}, true}}};
    const auto runs = sweep_workers(*seen, subjects, family.rounds, tick);
    tick();
    const auto truth = properties::judge_case(*seen, contract, jobs_);
    judge_plugin(*seen, runs[0], truth, wrong, out);
    judge_built_in(*seen, runs[1], truth, options, wrong);
    if (out.ended.empty()) {
      out.step = compared(runs[0].ms_a_step, runs[1].ms_a_step);
      out.create = compared(runs[0].create_ms, runs[1].create_ms);
    }
    return out;
  }

 private:
  void judge_plugin(const corpus::Case& seen, const WorkerRuns& runs,
                    const std::vector<oracle::StepJudgement>& truth,
                    std::vector<std::string>& wrong, ComparedSequence& out) const {
    out.ended = runs.ended;
    const auto judged = judge_run(seen, *runs.first, truth, claims_, plugin_.detector.contract);
    for (const auto& diff : judged.steps) out.errors += errors_of(diff);
    // A run that broke off has no steps.
    if (judged.steps.empty()) out.errors.steps = out.errors.undecided = truth.size();
    for (const auto claim : judged.broken) out.broken.emplace_back(name_of(claim));
    if (claims_.has(properties::Claim::deterministic) && runs.has_differing_runs)
      out.broken.emplace_back(name_of(properties::Claim::deterministic));
    for (const auto& claim : out.broken)
      wrong.push_back(fmt::format("{}: {} breaks {}", out.name, plugin_.description.name, claim));
  }

  static void judge_built_in(const corpus::Case& seen, const WorkerRuns& runs,
                             const std::vector<oracle::StepJudgement>& truth,
                             const detector::Options& options, std::vector<std::string>& wrong) {
    if (!runs.ended.empty())
      wrong.push_back(fmt::format("{}: the built-in detector's run {}", seen.id, runs.ended));
    const auto& answers = runs.first->steps;
    for (std::size_t s = 0; s < answers.size(); ++s) {
      const auto diff = properties::compare(answers[s], truth[s], properties::claims_of(options),
                                            properties::contract_of(options), seen.triangles);
      if (diff.outcome == Outcome::holds) continue;
      wrong.push_back(fmt::format("{}, step {}: the built-in detector: {}", seen.id, s + 1,
                                  name_of(diff.outcome)));
    }
  }

  const properties::Subject& plugin_;
  const properties::Claims& claims_;
  const int jobs_;
  properties::WorkerProcess of_plugin_, of_built_in_;
};

// What is compared, then one row for each sequence: the times of both, their ratio with its
// interval, the same for preprocessing, and errors.
std::string sequences_text(const std::vector<ComparedSequence>& sequences, bool all_pairs) {
  constexpr int widths[] = {-20, 9, 5, 9, 9, 22, 9, 9, 22, 6, 6, 9, 9, 7, 8, 9, -1};
  auto text = fmt::format(
      "beside the built-in detector, auto, exact, {} pairs; processor time in ms with all "
      "threads, medians\n",
      all_pairs ? "all" : "first");
  text += table_line(std::span(widths).first(16),
                     {"sequence", "triangles", "steps", "a step", "built-in", "over built-in",
                      "create", "built-in", "over built-in", "unsafe", "alarms", "late", "early",
                      "missing", "spurious", "undecided"});
  for (const auto& s : sequences) {
    const auto& e = s.errors;
    std::vector<std::string> words = {s.name, std::to_string(s.triangles),
                                      s.left_out
                                          ? fmt::format("{}-{}", s.steps + s.left_out, s.left_out)
                                          : std::to_string(s.steps)};
    for (const auto& time : {s.step, s.create}) {
      words.push_back(time ? fmt::format("{:.3g}", time->plugin_ms.value) : "-");
      words.push_back(time ? fmt::format("{:.3g}", time->built_in_ms.value) : "-");
      words.push_back(time ? fmt::format("{:.3g} [{:.3g}, {:.3g}]", time->over.value, time->over.lo,
                                         time->over.hi)
                           : "-");
    }
    for (const auto& word : {std::to_string(e.unsafe), std::to_string(e.false_alarms),
                             text_of(e.late), text_of(e.early), std::to_string(e.missing),
                             std::to_string(e.spurious), std::to_string(e.undecided)})
      words.push_back(word);
    if (!s.ended.empty()) words.push_back(" " + s.ended);
    text += table_line(std::span(widths).first(words.size()), words);
  }
  const bool has_left_out = std::any_of(sequences.begin(), sequences.end(),
                                        [](const auto& one) { return one.left_out > 0; });
  if (has_left_out) text += "steps 5-2: of 5, 2 are left out by the contract\n";
  return text;
}

Json json_of(const ComparedSequence& s) {
  return json_object("sequence", s.name, "kind", s.kind, "triangles", s.triangles, "steps", s.steps,
                     "left_out", s.left_out, "ended",
                     s.ended.empty() ? std::nullopt : std::optional(s.ended), "step", s.step,
                     "create", s.create, "errors", s.errors, "broken", s.broken);
}

}  // namespace

void to_json(Json& json, const ComparedTime& time) {
  json =
      json_object("plugin_ms", time.plugin_ms, "built_in_ms", time.built_in_ms, "over", time.over);
}

BenchReport detector_suite(const BenchSettings& settings, const properties::Subject& plugin,
                           const BenchProgress& progress,
                           std::vector<ComparedSequence>* sequences) {
  constexpr Eigen::Index most_triangles_when_quick = 10'000;
  BenchReport report("detector");
  ComparedWorkers workers(plugin, settings.jobs);
  std::vector<ComparedSequence> done;
  std::vector<std::string> missing;
  auto families = scene_families(settings);
  for (auto& real : real_families(settings, missing)) families.push_back(std::move(real));
  for (const auto& family : families) {
    for (const auto& timed : family.cases()) {
      if (family.kind == "real" && settings.scale < 1 &&
          timed.c.triangles.rows() > most_triangles_when_quick) {
        report.add_left_out(family.name, "left out: of more triangles than --quick takes");
        continue;
      }
      progress.phase(family.name);
      done.push_back(workers.compare(timed, family, report.wrong_answers, progress.tick));
      report.add_figure("sequences", json_of(done.back()));
      report.add_sample(json_of(done.back()));
    }
  }
  for (const auto& file : missing) report.add_no_data("public sequence", file);
  const auto& about = plugin.description;
  const auto& claims = plugin.detector.claims;
  std::vector<const char*> claim_names;
  for (const auto claim : properties::list_of(claims)) claim_names.push_back(name_of(claim));
  report.above =
      plugin_text(plugin) + "\n" + sequences_text(done, claims.has(properties::Claim::all_pairs));
  report.figures["detector"] =
      json_object("name", about.name, "version", about.version, "library", plugin.plugin->string(),
                  "claims", claim_names, "isolation", text_of(plugin.limits.least), "threads",
                  plugin.limits.threads, "contract", properties::json_of(about.contract));
  if (sequences) *sequences = std::move(done);
  return report;
}

}  // namespace assay::reports
