#include "properties/campaign/campaign_facts.h"
#include "properties/laws/law.h"
#include "reports/certificate/sections.h"
#include "reports/statistics.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using Outcomes = properties::StratumTally::Outcomes;

std::uint64_t count_of(const properties::Counts& counts, const std::string& name) {
  const auto found = counts.find(name);
  return found == counts.end() ? 0 : found->second;
}

// A trial that breaks any claim of a configuration counts against its bound, so one bound holds for
// all its claims; they are counted all the same, as DESIGN has it: that only widens the bounds.
std::uint64_t bounds_of(const Json& binding) {
  std::uint64_t claims = 0;
  for (const auto& configuration : binding["detector"]["configurations"])
    claims += configuration["claims"].size();
  return claims * binding["campaign"]["strata"].size();
}

}  // namespace

Json confidence_json(const Findings& findings) {
  const auto bounds = bounds_of(findings.binding);
  return {{"family", family_confidence},
          {"bounds", bounds},
          {"risk_of_each", risk_of_each(bounds)},
          {"method",
           "exact one-sided bound of Clopper and Pearson; Bonferroni over strata, claims and "
           "configurations"},
          {"speaks_of",
           "the cases that the named generator makes, not the user's meshes: the share of them "
           "on which a claim does not hold"}};
}

Json strata_json(const Findings& findings) {
  const double risk = risk_of_each(bounds_of(findings.binding));
  const auto& configurations = findings.binding["detector"]["configurations"];
  Json list = Json::array();
  for (const auto& stratum : findings.binding["campaign"]["strata"]) {
    const auto family = stratum["family"].get<std::string>();
    const auto found = findings.tally.strata.find(family);
    const properties::StratumTally none;
    const auto& tally = found == findings.tally.strata.end() ? none : found->second;
    Json bounds = Json::array();
    for (std::size_t c = 0; c < configurations.size(); ++c) {
      const auto outcomes =
          c < tally.by_configuration.size() ? tally.by_configuration[c] : Outcomes{};
      const auto n = outcomes.holds + outcomes.defects + outcomes.undecided + outcomes.errors;
      bounds.push_back({{"configuration", configurations[c]["name"]},
                        {"n", n},
                        {"holds", outcomes.holds},
                        {"defects", outcomes.defects},
                        {"undecided", outcomes.undecided},
                        {"errors", outcomes.errors},
                        {"bound", upper_bound(n - outcomes.holds, n, risk)}});
    }
    const double wanted = stratum["bound"].get<double>();
    list.push_back({{"family", family},
                    {"planned", stratum["cases"]},
                    {"trials", tally.trials},
                    {"discards", tally.discards},
                    {"distinct", tally.meshes.size()},
                    {"steps", tally.steps},
                    {"collisions", tally.collisions},
                    {"pairs", tally.pairs},
                    {"wanted_bound", wanted > 0 ? Json(wanted) : Json(nullptr)},
                    {"bounds", std::move(bounds)}});
  }
  return list;
}

Json laws_json(const Findings& findings) {
  const auto& campaign = findings.binding["campaign"];
  const bool ran = findings.binding["detector"]["built_in"].get<bool>() &&
                   campaign["laws_every"].get<std::uint64_t>() > 0 && !campaign["strata"].empty();
  if (!ran) return nullptr;
  Json list = Json::array();
  for (const auto& law : properties::laws()) {
    const std::string key = "law:" + std::string(law.name);
    const auto& counts = findings.tally.counts;
    list.push_back({{"law", law.name},
                    {"number", law.number},
                    {"premises", count_of(counts, key + "/premise")},
                    {"close", count_of(counts, key + "/close")},
                    {"broken", count_of(counts, key + "/broken")}});
  }
  return {{"wanted_premises", campaign["law_premises"]}, {"laws", std::move(list)}};
}

}  // namespace assay::reports
