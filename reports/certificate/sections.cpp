#include "reports/certificate/sections.h"

#include <set>

#include "corpus/cases/case_file.h"
#include "corpus/digest.h"
#include "properties/campaign/gates/failure_groups.h"
#include "properties/campaign/gates/findings.h"
#include "properties/campaign/gates/not_judged.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/campaign/ledger/step_measures.h"
#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/plan.h"
#include "properties/faults/fault.h"
#include "properties/fields.h"
#include "properties/reducer/mesh_size.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/campaign/failure_text.h"
#include "reports/steps/measures_text.h"

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

// What the row of a piece of evidence says of it, under the keys of
// properties/campaign/ledger/evidence.cpp; but not its name.
template <class T>
Json facts_of(const T& evidence) {
  Json facts = Json::parse(to_row(evidence).fields);
  facts.erase("name");
  return facts;
}

template <class T>
Json facts_of_each(const std::vector<T>& list) {
  Json rows;  // null if there is none
  for (const auto& row : list) rows.push_back(facts_of(row));
  return rows;
}

template <class T>
Json named(const char* key, const std::string& name, const T& evidence) {
  Json json = {{key, name}};
  json.update(facts_of(evidence));
  return json;
}

Json number_or_null(const std::optional<std::uint64_t>& number) {
  return number ? Json(*number) : Json(nullptr);
}

Json canaries_json(const RunFindings& findings) {
  Json list = Json::array();
  for (const auto& canary : findings.evidence.canaries)
    list.push_back({{"fault", canary.fault}, {"found_after", number_or_null(canary.found_after)}});
  return list;
}

Json faults_json(const RunFindings& findings) {
  Json list = Json::array();
  for (const auto& proof : findings.evidence.faults) {
    Json fault = named("fault", proof.fault, proof);
    const auto* registered = properties::find_fault(proof.fault);
    fault["about"] = registered ? Json(registered->about) : Json(nullptr);
    fault["found"] = proof.found();
    fault["found_at_random"] = proof.found_at_random();
    fault["median_cases"] = number_or_null(proof.median());
    list.push_back(std::move(fault));
  }
  return list;
}

Json worlds_json(const RunFindings& findings) {
  Json list = Json::array();
  for (const auto& world : findings.evidence.worlds) {
    // If the time ended a world, the numbers of classes and motions stand among the times only.
    const bool is_settled = world.complete || world.counterexample;
    list.push_back(
        {{"world", world.world},
         {"complete", world.complete},
         {"classes", is_settled ? Json(world.classes) : Json(nullptr)},
         {"motions", is_settled ? Json(world.motions) : Json(nullptr)},
         {"counterexample", world.counterexample ? Json(*world.counterexample) : Json(nullptr)}});
  }
  return list;
}

Json size_json(const std::string& text) {
  const auto c = corpus::parse_case(text, "stored failure");
  if (!c) return nullptr;
  const auto size = properties::size_of(c.value());
  Json json = {{"triangles", size.triangles}, {"vertices", size.vertices}, {"steps", size.steps}};
  if (properties::query_of(c.value())) json["query"] = properties::query_word(c.value());
  return json;
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

Json not_judged_json(const RunFindings& findings) {
  Json list = Json::array();
  for (const auto& [claim, reason] : properties::not_judged(findings))
    list.push_back({{"claim", claim}, {"reason", reason}});
  return list;
}

Json judged_up_to_json(const RunFindings& findings) {
  Json list = Json::array();
  for (const auto& [claim, triangles] : properties::judged_sizes(findings))
    list.push_back({{"claim", claim}, {"triangles", triangles}});
  return list;
}

Json tried_json(const RunFindings& findings) {
  if (properties::asks_queries_alone(findings.run.plan)) return nullptr;
  return {{"largest", properties::json_of_fields<Json>(properties::largest_tried(findings))},
          {"relations", findings.tally.counts.measures.relation_trials}};
}

Json power_json(const RunFindings& findings) {
  const auto& taken = findings.evidence.power;
  return {{"canaries", canaries_json(findings)},
          {"taken_from", taken.empty() ? Json(nullptr) : facts_of(taken.front())},
          {"planted", findings.planted()},
          {"found", findings.found()},
          {"found_at_random", findings.found_at_random()},
          {"found_by_curated_case_alone", findings.found() - findings.found_at_random()},
          {"faults", faults_json(findings)},
          {"worlds", worlds_json(findings)}};
}

Json self_test_json(const RunFindings& findings) {
  if (findings.evidence.self_test.empty()) return nullptr;
  Json families = Json::array();
  std::uint64_t queries = 0, contradictions = 0;
  bool complete = true;
  for (const auto& row : findings.evidence.self_test) {
    queries += row.queries;
    contradictions += row.contradictions;
    complete &= row.complete;
    families.push_back(named("family", row.family, row));
  }
  return {{"queries", queries},
          {"contradictions", contradictions},
          {"complete", complete},
          {"families", std::move(families)}};
}

Json corpus_json(const RunFindings& findings) { return facts_of_each(findings.evidence.corpus); }

Json repeated_json(const RunFindings& findings) {
  return facts_of_each(findings.evidence.repeated);
}

Json search_json(const RunFindings& findings) {
  const auto planned = findings.shares_of(findings.run.plan.search);
  if (planned == 0) return nullptr;
  const auto [lanes, asked, cases, defects, open, causes] = findings.searched();
  std::set<std::string> words;
  for (const auto& lane : findings.evidence.search)
    words.insert(lane.causes.begin(), lane.causes.end());
  std::uint64_t found = 0;
  for (const auto* failure : findings.kinds()) found += is_of_search(*failure) ? 1 : 0;
  return {{"planned", planned}, {"lanes", lanes}, {"cases", cases},
          {"defects", defects}, {"found", found}, {"causes", words}};
}

Json times_json(const RunFindings& findings) {
  const auto& [issued, speed] = std::tie(findings.evidence.issued, findings.evidence.speed);
  Json figures = Json::array(), strata = Json::array(), worlds = Json::array(),
       files = Json::array();
  for (const auto& figure : speed) figures.push_back(named("what", figure.name, figure));
  for (const auto& [family, tally] : findings.tally.strata)
    strata.push_back({{"family", family},
                      {"oracle_us", tally.oracle_us},
                      {"detector_us", tally.detector_us},
                      {"disturbed", tally.disturbed}});
  for (const auto& world : findings.evidence.worlds)
    worlds.push_back({{"world", world.world},
                      {"classes", world.classes},
                      {"all", world.all},
                      {"motions", world.motions}});
  // The digests of the stores stand here, because stores hold times, and so their bytes differ
  // from run to run.
  for (const auto& file : findings.files)
    files.push_back({{"name", file.name}, {"sha256", file.sha256}});
  return {{"issued", issued ? Json(issued->at) : Json(nullptr)},
          {"seconds", issued ? Json(issued->seconds) : Json(nullptr)},
          {"speed", std::move(figures)},
          {"strata", std::move(strata)},
          {"near_the_limit", findings.tally.near_limit.size()},
          {"worlds", std::move(worlds)},
          {"files", std::move(files)}};
}

Json failures_json(const RunFindings& findings) {
  Json list = Json::array();
  for (const auto* failure : findings.kinds()) {
    const bool is_shrunk = !failure->smallest.empty();
    const auto name = properties::failure_file(*failure, is_shrunk);
    const auto& mesh = is_shrunk ? failure->smallest : failure->mesh;
    list.push_back({{"signature", failure->signature},
                    {"claim", failure->signature.substr(0, failure->signature.find(':'))},
                    {"configuration", failure->configuration},
                    {"met", findings.met_count(*failure)},
                    {"flaky", failure->flaky},
                    {"what", shown_explanation(*failure)},
                    {"case", failure->id},
                    {"before", size_json(failure->mesh)},
                    {"after", is_shrunk ? size_json(failure->smallest) : Json(nullptr)},
                    {"file", name.generic_string()},
                    {"sha256", corpus::sha256_of(mesh)},
                    {"replay", "assay " + replay_words("", name, detector_of(findings))}});
  }
  return list;
}

Json failure_groups_json(const RunFindings& findings) {
  Json list = Json::array();
  const auto kinds = findings.kinds().size();
  for (const auto& group : properties::failure_groups(findings))
    list.push_back({{"what", properties::text_of(group, kinds)},
                    {"kinds", group.kinds},
                    {"smallest", group.smallest}});
  return list;
}

}  // namespace assay::reports
