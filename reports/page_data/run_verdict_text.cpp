#include "reports/page_data/run_verdict_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/campaign_facts.h"
#include "reports/page_data/run_json.h"

namespace assay::reports {
namespace {

constexpr const char* passed = "passed";
constexpr const char* failed = "failed";
constexpr const char* not_judged = "not judged";

// What the harness owes of itself, and does not deliver: a line each.
std::vector<std::string> harness_faults(const StoredRun& run) {
  auto lines = run.evidence.problems;
  const auto& canary = run.evidence.canary;
  if (canary.is_object() && canary["found_after"].is_null())
    lines.push_back("the canary was not found");
  for (const auto& fault : run.evidence.faults) {
    const auto name = fault["name"].get<std::string>();
    const bool found = fault["found"].get<bool>(), time_over = fault["time_over"].get<bool>();
    if (fault["status"] == "planted" && !found && !time_over)
      lines.push_back(fmt::format("planted fault {} was not found", name));
    if (fault["status"] == "equivalent" && found)
      lines.push_back(fmt::format("{}, registered as equivalent, was found", name));
  }
  if (run.detector.built_in && run.trials() == run.planned_trials()) {
    for (auto& line : properties::starved_laws(run.tally.counts, run.wanted_premises))
      lines.push_back(std::move(line));
  }
  return lines;
}

std::size_t faults_out_of_time(const StoredRun& run) {
  return static_cast<std::size_t>(
      std::count_if(run.evidence.faults.begin(), run.evidence.faults.end(), [](const auto& fault) {
        return fault["status"] == "planted" && !fault["found"] && fault["time_over"];
      }));
}

Gate harness_gate(const StoredRun& run) {
  const std::string name = "harness sound";
  const auto lines = harness_faults(run);
  if (!lines.empty()) {
    return {
        name, failed,
        lines.size() == 1 ? lines[0] : fmt::format("{}; and {} more", lines[0], lines.size() - 1)};
  }
  const auto& canary = run.evidence.canary;
  if (canary.is_null()) return {name, not_judged, "no canary was met"};
  const auto text = fmt::format("the canary was found after {} cases",
                                canary["found_after"].template get<std::uint64_t>());
  if (run.evidence.faults.is_null()) return {name, passed, text + "; no faults were planted"};
  return {name, passed,
          faults_out_of_time(run) == 0 ? text + "; every planted fault was found" : text};
}

Gate complete_gate(const StoredRun& run) {
  const std::string name = "complete";
  if (run.shards.size() < run.shard_count) {
    return {name, failed,
            fmt::format("{} of {} shards are here", run.shards.size(), run.shard_count)};
  }
  const auto out_of_time = faults_out_of_time(run);
  if (out_of_time > 0) {
    return {name, failed,
            fmt::format("the time was over before {} planted faults were found", out_of_time)};
  }
  const auto done = run.trials(), planned = run.planned_trials();
  return {name, done == planned ? passed : failed,
          fmt::format("{} of {} planned trials were judged", done, planned)};
}

Gate claims_gate(const StoredRun& run) {
  const auto broken = properties::broken_laws(run.tally.counts);
  const auto defects = defect_trials(run);
  for (const auto& world : run.evidence.worlds) {
    if (!world["counterexample"].is_null())
      return {"claims hold", failed, world["counterexample"].get<std::string>()};
  }
  if (defects == 0 && broken == 0) {
    return {"claims hold", run.trials() > 0 ? passed : not_judged,
            fmt::format("no defect in {} trials", run.trials())};
  }
  return {"claims hold", failed,
          fmt::format("{} trials show a defect of {} kinds{}", defects, run.met.size(),
                      broken ? fmt::format("; {} laws are broken", broken) : "")};
}

// As the terminal judges it: a wanted bound is met; where none is wanted, nothing is left open.
Gate bounds_gate(const StoredRun& run) {
  const std::string name = "bounds met";
  bool wanted = false;
  const auto rows = run_strata(run);
  for (const auto& row : rows) {
    const auto family = row["family"].get<std::string>();
    if (row["wanted"].is_null()) {
      if (row["undecided"] > 0)
        return {name, failed, fmt::format("{}: trials have no verdict", family)};
      continue;
    }
    wanted = true;
    if (row["bound"] > row["wanted"])
      return {name, failed, fmt::format("the bound of {} is above what is wanted", family)};
  }
  if (run.trials() == 0) return {name, not_judged, "nothing was judged"};
  return {name, passed, wanted ? "every wanted bound is met" : "this campaign wants none"};
}

}  // namespace

RunVerdictText verdict_of(const StoredRun& run) {
  RunVerdictText verdict;
  verdict.gates = {harness_gate(run),
                   complete_gate(run),
                   {"corpus passes", not_judged, "assay certify judges it"},
                   claims_gate(run),
                   bounds_gate(run),
                   {"speed within limit", not_judged, "assay certify measures it"}};
  const auto fails = [&](std::string_view name) {
    return std::any_of(verdict.gates.begin(), verdict.gates.end(),
                       [&](const Gate& gate) { return gate.name == name && gate.state == failed; });
  };
  // The order of the exit codes: what an unsound harness or a defect says does not rest on the
  // rest.
  const std::pair<const char*, const char*> words[] = {{"harness sound", "unsound-harness"},
                                                       {"claims hold", "defect"},
                                                       {"complete", "incomplete"},
                                                       {"bounds met", "undecided"}};
  for (const auto& [gate, word] : words) {
    if (!fails(gate)) continue;
    verdict.word = word;
    const auto found = std::find_if(verdict.gates.begin(), verdict.gates.end(),
                                    [&](const Gate& g) { return g.name == gate; });
    verdict.why = found->text;
    return verdict;
  }
  verdict.word = "holds";
  verdict.why = fmt::format("no defect in {} trials; a run alone is no certificate", run.trials());
  return verdict;
}

}  // namespace assay::reports
