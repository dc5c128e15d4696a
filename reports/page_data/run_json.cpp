#include "reports/page_data/run_json.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/campaign/bounds.h"
#include "properties/campaign/count_names.h"
#include "properties/campaign/statistics.h"
#include "reports/page_data/evidence_json.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using properties::GateState;
using properties::RunFindings;
using Outcomes = properties::StratumTally::Outcomes;

Json stratum_row(const RunFindings& findings, const properties::StratumPlan& planned,
                 const Outcomes& outcomes, std::vector<std::string> names) {
  const auto& tally = findings.tally_of(planned);
  const double seconds = 1e-6 * static_cast<double>(tally.oracle_us + tally.detector_us);
  return {{"family", planned.family},
          {"configurations", std::move(names)},
          {"planned", findings.planned(planned)},
          {"n", outcomes.trials()},
          {"holds", outcomes.holds},
          {"defects", outcomes.defects},
          {"undecided", outcomes.open()},
          {"disturbed", tally.disturbed},
          {"bound", bound_of(outcomes, findings.run)},
          {"wanted", planned.wanted_bound > 0 ? Json(planned.wanted_bound) : Json()},
          {"steps", tally.steps},
          {"collisions", tally.collisions},
          {"steps_per_second",
           seconds > 0 ? Json(static_cast<double>(tally.steps) / seconds) : Json()}};
}

// One row for configurations that agree in all of a family's counts, else a row for each.
Json strata_json(const RunFindings& findings) {
  std::vector<std::string> names;
  for (const auto& configuration : findings.run.detector.configurations)
    names.push_back(configuration.name);
  Json rows = Json::array();
  for (const auto& planned : findings.run.plan.strata) {
    const auto& all = findings.tally_of(planned).by_configuration;
    const bool all_same =
        std::all_of(all.begin(), all.end(), [&](const Outcomes& one) { return one == all[0]; });
    if (all_same) {
      rows.push_back(stratum_row(findings, planned, all.empty() ? Outcomes{} : all[0], names));
      continue;
    }
    for (std::size_t c = 0; c < std::min(all.size(), names.size()); ++c)
      rows.push_back(stratum_row(findings, planned, all[c], {names[c]}));
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

Json laws_json(const RunFindings& findings) {
  const auto wanted = findings.laws_are_judged() ? findings.run.plan.law_premises : 0;
  Json list = Json::array();
  for (const auto& [law, tally] : properties::laws_in(findings.tally.counts)) {
    if (tally.premise == 0 && wanted == 0) continue;
    list.push_back({{"name", law->name},
                    {"premise", tally.premise},
                    {"close", tally.close},
                    {"broken", tally.broken},
                    {"wanted_premise", wanted}});
  }
  return list;
}

Json set_pairs_json(const properties::Counts& counts) {
  Json list = Json::array();
  for (const auto& [sets, contacts, first] : properties::set_pairs_in(counts))
    list.push_back({{"sets", sets}, {"contacts", contacts}, {"first_contacts", first}});
  return list;
}

Json counts_json(const auto& counts) {
  Json json = Json::object();
  for (const auto& [name, count] : counts) json[name] = count;
  return json;
}

Json gates_json(const properties::Judgement& judgement) {
  Json list = Json::array();
  for (const auto& [gate, state, reasons] : judgement.gates) {
    const auto& rule = properties::rule_of(gate);
    list.push_back({{"gate", rule.name},
                    {"asks", rule.asks},
                    {"state", name_of(state)},
                    {"reasons", reasons}});
  }
  return list;
}

std::string why_text(const properties::Judgement& judgement) {
  if (!judgement.failed) {
    return judgement.verdict == "not judged" ? "no gate was judged" : "no gate fails";
  }
  const auto& reasons = judgement.of(*judgement.failed).reasons;
  return fmt::format("gate \"{}\" fails: {}{}", properties::rule_of(*judgement.failed).name,
                     reasons[0],
                     reasons.size() > 1 ? fmt::format("; and {} more", reasons.size() - 1) : "");
}

// The worst of all shards: one that was not found is worse than any number of cases.
Json canary_json(const RunFindings& findings) {
  const auto& all = findings.evidence.canaries;
  if (all.empty()) return nullptr;
  const auto& worst = *std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.found_after && (!b.found_after || *a.found_after < *b.found_after);
  });
  return {{"fault", worst.fault},
          {"found_after", worst.found_after ? Json(*worst.found_after) : Json()}};
}

Json shards_json(const RunFindings& findings) {
  Json present = Json::array();
  for (const auto& shard : findings.shards) present.push_back(shard.index);
  return {{"count", findings.shard_count}, {"present", std::move(present)}};
}

}  // namespace

Json run_json(const RunFindings& findings, const properties::Judgement& judgement,
              const Json& statement, const std::string& unverified) {
  Json configurations = Json::array();
  for (const auto& configuration : findings.run.detector.configurations)
    configurations.push_back(configuration.name);
  const auto& library = findings.library;
  return {{"folder", findings.folder.string()},
          {"campaign", findings.run.plan.name},
          {"seed", findings.run.seed},
          {"shards", shards_json(findings)},
          {"detector",
           {{"name", findings.run.detector.name},
            {"built_in", findings.run.detector.built_in},
            {"library", library.empty() ? Json() : Json(library)},
            {"configurations", std::move(configurations)}}},
          {"verdict", unverified.empty() ? judgement.verdict : "unverified"},
          {"why", unverified.empty() ? why_text(judgement)
                                     : "the certificate does not verify: " + unverified},
          {"gates", gates_json(judgement)},
          {"trials",
           {{"done", findings.tally.trials()},
            {"planned", findings.planned()},
            {"disturbed", findings.tally.disturbed()},
            {"near_the_limit", findings.tally.near.size()}}},
          {"defect_trials", findings.tally.with_defect()},
          {"bounds",
           {{"confidence", properties::family_confidence},
            {"together", number_of_bounds(findings.run)}}},
          {"strata", strata_json(findings)},
          {"distributions", distributions_json(findings.tally)},
          {"set_pairs", set_pairs_json(findings.tally.counts)},
          {"tags", counts_json(properties::tags_in(findings.tally.counts))},
          {"laws", laws_json(findings)},
          {"canary", canary_json(findings)},
          {"faults", faults_json(findings)},
          {"faults_taken_from", faults_taken_from(findings)},
          {"worlds", worlds_json(findings)},
          {"signatures", counts_json(findings.met)},
          {"certificate", statement.is_null() ? Json() : certificate_json(statement)}};
}

}  // namespace assay::reports
