#include "reports/page_data/run_json.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/campaign_facts.h"
#include "reports/page_data/run_verdict_text.h"
#include "reports/statistics.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using Outcomes = properties::StratumTally::Outcomes;

bool same(const Outcomes& a, const Outcomes& b) {
  return a.holds == b.holds && a.defects == b.defects && a.undecided == b.undecided &&
         a.errors == b.errors;
}

std::string configuration_name(const StoredRun& run, std::size_t c) {
  const auto& names = run.detector.configurations;
  return c < names.size() ? names[c] : fmt::format("configuration {}", c + 1);
}

// Every claim is counted, as in the certificate (certificate/strata_section.cpp).
std::uint64_t bounds_together(const StoredRun& run) {
  return run.strata.size() * run.detector.claims;
}

Json stratum_row(const StoredRun& run, const PlannedStratum& planned,
                 const properties::StratumTally& tally, const Outcomes& outcomes,
                 std::vector<std::string> names) {
  const auto n = outcomes.holds + outcomes.defects + outcomes.undecided + outcomes.errors;
  const double seconds = 1e-6 * static_cast<double>(tally.oracle_us + tally.detector_us);
  return {{"family", planned.family},
          {"configurations", std::move(names)},
          {"planned", planned.cases},
          {"n", n},
          {"holds", outcomes.holds},
          {"defects", outcomes.defects},
          {"undecided", outcomes.undecided + outcomes.errors},
          {"bound", upper_bound(n - outcomes.holds, n, risk_of_each(bounds_together(run)))},
          {"wanted", planned.wanted_bound > 0 ? Json(planned.wanted_bound) : Json()},
          {"steps", tally.steps},
          {"collisions", tally.collisions},
          {"steps_per_second",
           seconds > 0 ? Json(static_cast<double>(tally.steps) / seconds) : Json()}};
}

// One row for configurations that agree in all of a family's counts, else a row for each.
Json strata_json(const StoredRun& run) {
  Json rows = Json::array();
  for (const auto& planned : run.strata) {
    const auto found = run.tally.strata.find(planned.family);
    if (found == run.tally.strata.end()) {
      rows.push_back(stratum_row(run, planned, {}, {}, run.detector.configurations));
      continue;
    }
    const auto& tally = found->second;
    std::vector<std::string> names;
    for (std::size_t c = 0; c < tally.by_configuration.size(); ++c)
      names.push_back(configuration_name(run, c));
    const bool all_same = std::all_of(
        tally.by_configuration.begin(), tally.by_configuration.end(),
        [&](const Outcomes& outcomes) { return same(outcomes, tally.by_configuration[0]); });
    if (all_same && !names.empty()) {
      rows.push_back(stratum_row(run, planned, tally, tally.by_configuration[0], names));
      continue;
    }
    for (std::size_t c = 0; c < names.size(); ++c)
      rows.push_back(stratum_row(run, planned, tally, tally.by_configuration[c], {names[c]}));
  }
  return rows;
}

// [from, to, count] of numbers by their power of two; [0, 0, count] for none at all.
Json histogram(const std::map<int, std::uint64_t>& counts) {
  Json list = Json::array();
  for (const auto& [log2, count] : counts) {
    const std::uint64_t lo = log2 < 0 ? 0 : std::uint64_t{1} << log2;
    list.push_back({lo, log2 < 0 ? 0 : 2 * lo - 1, count});
  }
  return list;
}

Json distributions_json(const properties::Tally& tally) {
  Json list = Json::array();
  for (const auto& [family, stratum] : tally.strata) {
    list.push_back({{"family", family},
                    {"triangles", histogram(stratum.sizes)},
                    {"pairs", histogram(stratum.contacts)}});
  }
  return list;
}

std::uint64_t count_of(const properties::Counts& counts, const std::string& name) {
  const auto found = counts.find(name);
  return found == counts.end() ? 0 : found->second;
}

template <class Visit>
void with_prefix(const properties::Counts& counts, std::string_view prefix, Visit visit) {
  for (auto it = counts.lower_bound(prefix); it != counts.end() && it->first.starts_with(prefix);
       ++it) {
    visit(it->first.substr(prefix.size()), it->second);
  }
}

Json laws_json(const StoredRun& run) {
  Json list = Json::array();
  const std::string_view end = "/premise";
  with_prefix(run.tally.counts, "law:", [&](const std::string& name, std::uint64_t premise) {
    if (!name.ends_with(end)) return;
    const std::string law = name.substr(0, name.size() - end.size());
    list.push_back({{"name", law},
                    {"premise", premise},
                    {"close", count_of(run.tally.counts, "law:" + law + "/close")},
                    {"broken", count_of(run.tally.counts, "law:" + law + "/broken")},
                    {"wanted_premise", run.wanted_premises}});
  });
  return list;
}

Json counts_json(const properties::Counts& counts, std::string_view prefix) {
  Json json = Json::object();
  with_prefix(counts, prefix,
              [&](const std::string& name, std::uint64_t count) { json[name] = count; });
  return json;
}

Json set_pairs_json(const properties::Counts& counts) {
  Json list = Json::array();
  with_prefix(counts, "block:", [&](const std::string& sets, std::uint64_t contacts) {
    list.push_back({{"sets", sets},
                    {"contacts", contacts},
                    {"first_contacts", count_of(counts, "first:" + sets)}});
  });
  return list;
}

}  // namespace

Json run_strata(const StoredRun& run) { return strata_json(run); }

std::uint64_t defect_trials(const StoredRun& run) {
  std::uint64_t sum = 0;
  for (const auto& [family, tally] : run.tally.strata) {
    std::uint64_t most = 0;
    for (const auto& outcomes : tally.by_configuration) most = std::max(most, outcomes.defects);
    sum += most;
  }
  return sum;
}

Json run_json(const StoredRun& run) {
  const auto verdict = verdict_of(run);
  Json gates = Json::array();
  for (const auto& gate : verdict.gates)
    gates.push_back({{"name", gate.name}, {"state", gate.state}, {"text", gate.text}});
  const auto& detector = run.detector;
  return {{"folder", run.folder.string()},
          {"campaign", run.campaign},
          {"seed", run.seed},
          {"shards", {{"count", run.shard_count}, {"present", run.shards}}},
          {"detector",
           {{"name", detector.name},
            {"built_in", detector.built_in},
            {"library", detector.library.empty() ? Json() : Json(detector.library)},
            {"configurations", detector.configurations}}},
          {"verdict", verdict.word},
          {"certified", verdict.certified},
          {"why", verdict.why},
          {"gates", std::move(gates)},
          {"trials", {{"done", run.trials()}, {"planned", run.planned_trials()}}},
          {"defect_trials", defect_trials(run)},
          {"bounds", {{"confidence", 0.95}, {"together", bounds_together(run)}}},
          {"strata", strata_json(run)},
          {"distributions", distributions_json(run.tally)},
          {"set_pairs", set_pairs_json(run.tally.counts)},
          {"tags", counts_json(run.tally.counts, "tag:")},
          {"laws", laws_json(run)},
          {"canary", run.evidence.canary},
          {"faults", run.evidence.faults},
          {"worlds", run.evidence.worlds},
          {"signatures", counts_json(run.met, "")},
          {"certificate", nullptr}};
}

}  // namespace assay::reports
