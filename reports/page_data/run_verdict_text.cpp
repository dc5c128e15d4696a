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

std::vector<std::string> missing_faults(const StoredRun& run) {
  std::vector<std::string> names;
  if (!run.faults.is_array()) return names;
  for (const auto& fault : run.faults) {
    if (fault.value("status", "") == "planted" && !fault.value("found", false))
      names.push_back(fault.value("name", "?"));
  }
  return names;
}

Gate harness_gate(const StoredRun& run) {
  const std::string name = "harness sound";
  for (const auto& end : run.ends) {
    if (!end.harness.empty()) return {name, failed, end.harness.front()};
  }
  if (!run.canary.is_object()) return {name, not_judged, "the store does not say"};
  if (run.canary["found_after"].is_null()) return {name, failed, "the canary was not found"};
  std::string text = fmt::format("the canary was found after {} cases",
                                 run.canary["found_after"].get<std::uint64_t>());
  if (!run.faults.is_array()) return {name, passed, text + "; no faults were planted"};
  const auto missing = missing_faults(run);
  if (missing.empty()) return {name, passed, text + "; every planted fault was found"};
  return {name, not_judged,
          fmt::format("{}; the time was over before {} planted faults were found", text,
                      missing.size())};
}

Gate complete_gate(const StoredRun& run) {
  const std::string name = "complete";
  if (run.shards.size() < run.shard_count) {
    return {name, failed,
            fmt::format("{} of {} shards are here", run.shards.size(), run.shard_count)};
  }
  const auto done = run.trials(), planned = run.planned_trials();
  return {name, done == planned ? passed : failed,
          fmt::format("{} of {} planned trials were judged", done, planned)};
}

Gate claims_gate(const StoredRun& run) {
  const auto broken = properties::broken_laws(run.tally.counts);
  const auto defects = defect_trials(run);
  if (defects == 0 && broken == 0) {
    return {"claims hold", run.trials() > 0 ? passed : not_judged,
            fmt::format("no defect in {} trials", run.trials())};
  }
  return {"claims hold", failed,
          fmt::format("{} trials show a defect of {} kinds{}", defects, run.met.size(),
                      broken ? fmt::format("; {} laws are broken", broken) : "")};
}

Gate bounds_gate(const StoredRun& run) {
  const std::string name = "bounds met";
  const bool wanted = std::any_of(run.strata.begin(), run.strata.end(),
                                  [](const auto& stratum) { return stratum.wanted_bound > 0; });
  if (run.ends.size() < run.shard_count) return {name, not_judged, "the run did not end"};
  if (run.shard_count > 1) return {name, not_judged, "bounds are of all shards together"};
  const bool met = run.ends.front().bounds_met;
  if (!wanted) {
    return {name, met ? passed : failed,
            met ? "this campaign wants none" : "trials were left without a verdict"};
  }
  return {name, met ? passed : failed,
          met ? "every wanted bound is met" : "a bound is above what is wanted"};
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
