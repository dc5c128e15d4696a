#include <nlohmann/json.hpp>

#include "properties/campaign/gates/findings.h"
#include "properties/campaign/gates/not_judged.h"
#include "properties/campaign/ledger/step_measures.h"
#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/plan.h"
#include "properties/fields.h"
#include "reports/certificate/sections.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using properties::RunFindings;

Json bounds_json(const RunFindings& findings, const properties::StratumPlan& stratum) {
  Json list = Json::array();
  const auto configurations = configurations_in(findings.run.detector, stratum.family);
  for (std::size_t c = 0; c < configurations.size(); ++c) {
    const auto outcomes = findings.outcomes_of(stratum, c);
    list.push_back({{"configuration", configurations[c].name},
                    {"n", outcomes.trials()},
                    {"holds", outcomes.holds},
                    {"defects", outcomes.defects},
                    {"undecided", outcomes.undecided},
                    {"errors", outcomes.errors},
                    {"refused", outcomes.refused},
                    {"bound", bound_of(outcomes, stratum, findings.run)},
                    {"met", is_met(findings, stratum, c)}});
  }
  return list;
}

// A row [from, to, count] for each power of two, and [0, 0, count] for those that are 0.
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

Json set_pairs_json(const properties::TrialCounts& counts) {
  Json list = Json::array();
  for (const auto& [sets, count] : counts.set_pairs)
    list.push_back(
        {{"sets", sets}, {"contacts", count.contacts}, {"first_contacts", count.first_contacts}});
  return list;
}

}  // namespace

Json cases_json(const RunFindings& findings) {
  Json tags = Json::object();
  for (const auto& [tag, count] : findings.tally.counts.tags) tags[tag] = count;
  return {{"distributions", distributions_json(findings.tally)},
          {"set_pairs", set_pairs_json(findings.tally.counts)},
          {"tags", std::move(tags)}};
}

Json gates_json(const properties::Judgement& judgement) {
  Json list = Json::array();
  for (const auto& result : judgement.gates) {
    const auto& rule = properties::rule_of(result.gate);
    list.push_back({{"gate", rule.name},
                    {"asks", rule.asks},
                    {"state", name_of(result.state)},
                    {"verdict", rule.verdict},
                    {"exit_code", rule.exit_code},
                    {"reasons", result.reasons}});
  }
  return list;
}

Json confidence_json(const RunFindings& findings) {
  return {{"family", properties::family_confidence},
          {"bounds", number_of_bounds(findings.run)},
          {"risk_of_each", risk_of_each(findings.run)},
          {"method",
           "exact one-sided bound of Clopper and Pearson; Bonferroni over strata, claims and "
           "configurations"},
          {"speaks_of",
           "the cases that the named generator makes, not the user's meshes: the share of them "
           "on which a claim does not hold"}};
}

Json strata_json(const RunFindings& findings) {
  Json list = Json::array();
  for (const auto& stratum : findings.run.plan.strata) {
    const auto& tally = findings.tally_of(stratum);
    const double wanted = stratum.wanted_bound;
    list.push_back({{"family", stratum.family},
                    {"planned", findings.planned(stratum)},
                    {"trials", tally.trials},
                    {"discards", tally.discards},
                    {"with_contact", tally.measures.contact_trials},
                    {"with_defect", tally.with_defect},
                    {"distinct", tally.meshes.size()},
                    {"steps", tally.steps},
                    {"collisions", tally.collisions},
                    {"pairs", tally.pairs},
                    {"measures", findings.run.detector.built_in ? Json(nullptr)
                                                                : measures_json(tally.measures)},
                    {"risk", risk_in(stratum, findings.run)},
                    {"wanted_bound", wanted > 0 ? Json(wanted) : Json(nullptr)},
                    {"agree", configurations_agree(findings, stratum)},
                    {"bounds", bounds_json(findings, stratum)}});
  }
  return list;
}

Json laws_json(const RunFindings& findings) {
  const auto& plan = findings.run.plan;
  const bool built_in = findings.run.detector.built_in;
  const auto laws = properties::laws_in(findings.tally.counts, built_in);
  if (plan.laws_every == 0 || plan.strata.empty() || laws.empty()) return nullptr;
  Json list = Json::array();
  for (const auto& [law, tally] : laws) {
    Json by_culling = Json::array();
    for (const auto& [culling, premise] : properties::premises_by_culling(tally, *law)) {
      by_culling.push_back({{"culling", culling}, {"premises", premise}});
    }
    list.push_back({{"law", law->name},
                    {"number", law->number},
                    {"premises", tally.premise},
                    {"by_culling", std::move(by_culling)},
                    {"close", tally.close},
                    {"broken", tally.broken},
                    {"differs", tally.differs}});
  }
  return {{"wanted_premises", findings.laws_are_judged() ? plan.law_premises : 0},
          {"laws", std::move(list)}};
}

namespace {

using Json = nlohmann::ordered_json;

Json rate_json(const properties::Rate& rate) {
  return {{"of", rate.of},
          {"in", rate.in},
          {"share", rate.share()},
          {"interval", {rate.interval.lo, rate.interval.hi}}};
}

Json times_off_json(const properties::TimesOff& off) {
  return {{"steps", off.steps},
          {"median", off.quantile(0.5)},
          {"p99", off.quantile(0.99)},
          {"worst", off.quantile(1)}};
}

Json limits_json(const properties::LimitUse& use) {
  Json stalls = Json::array(), used = nullptr;
  for (const auto& [cause, steps] : use.stalls)
    stalls.push_back({{"cause", cause}, {"steps", steps}});
  if (use.contact > 0)
    used = {{"median", use.used(0.5)}, {"p1", use.used(0.01)}, {"worst", use.used(0)}};
  return {{"free", use.free},       {"cut", use.cut}, {"contact", use.contact},
          {"excused", use.excused}, {"used", used},   {"stalls", stalls}};
}

}  // namespace

Json not_judged_json(const properties::RunFindings& findings) {
  Json list = Json::array();
  for (const auto& [claim, reason] : properties::not_judged(findings))
    list.push_back({{"claim", claim}, {"reason", reason}});
  return list;
}

Json judged_up_to_json(const properties::RunFindings& findings) {
  Json list = Json::array();
  for (const auto& [claim, triangles] : properties::judged_sizes(findings))
    list.push_back({{"claim", claim}, {"triangles", triangles}});
  return list;
}

Json tried_json(const properties::RunFindings& findings) {
  if (properties::asks_queries_alone(findings.run.plan)) return nullptr;
  return {{"largest", properties::json_of_fields<Json>(properties::largest_tried(findings))},
          {"relations", findings.tally.counts.measures.relation_trials}};
}

Json measures_json(const properties::StepMeasures& m) {
  return {{"steps", m.errors.answered()},
          {"false_alarms", rate_json(false_alarm_rate(m))},
          {"answered_free", rate_json(miss_rate(m))},
          {"spurious_pairs", m.errors.spurious},
          {"spurious_pairs_a_step", spurious_pairs_a_step(m)},
          {"collisions", m.errors.collisions()},
          {"without_time", m.without_time},
          {"late", times_off_json(m.errors.late)},
          {"early", times_off_json(m.errors.early)},
          {"candidates",
           {{"steps", m.candidate_steps},
            {"given", m.candidates},
            {"least", m.least_candidates},
            {"over_least", candidates_over_least(m)}}},
          {"limits", limits_json(m.errors.limits)},
          {"near_at_start", m.starts_near},
          {"left_out",
           {{"cases_redrawn", m.redrawn},
            {"steps", m.steps_left_out},
            {"refused", m.refused},
            {"would_be_misses", m.left_out_misses}}}};
}

}  // namespace assay::reports
