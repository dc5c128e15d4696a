#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "corpus/cases/case_file.h"
#include "corpus/digest.h"
#include "corpus/json_fields.h"
#include "properties/campaign/gates/findings.h"
#include "properties/campaign/gates/gates.h"
#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/plan.h"
#include "properties/faults/fault.h"
#include "properties/fields.h"
#include "properties/judging/step_measures.h"
#include "properties/reducer/reducer.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/campaign/campaign_text.h"
#include "reports/certificate/statement.h"
#include "reports/steps/measures_text.h"
#include "reports/terminal/words.h"

namespace assay::reports {

// Each function renders a part of the findings or gates: a part of a certificate's predicate
// (reports/certificate/README.md).

namespace {

using Json = nlohmann::ordered_json;
using properties::RunFindings;
using properties::Source;

template <class List, class Make>
Json each(const List& list, const Make& make) {
  Json rows = Json::array();
  for (const auto& one : list) rows.push_back(make(one));
  return rows;
}

// Returns the fields of each item of a list (properties/fields.h).
template <class List>
Json fields_of_each(const List& list) {
  return each(list, [](const auto& one) { return properties::json_of_fields<Json>(one); });
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

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

// Returns a row [from, to, count] for each power of two, and [0, 0, count] for those that are 0.
Json histogram(const std::map<int, std::uint64_t>& counts) {
  return each(counts, [](const auto& one) -> Json {
    const std::uint64_t lo = one.first < 0 ? 0 : std::uint64_t{1} << one.first;
    return {lo, one.first < 0 ? 0 : 2 * lo - 1, one.second};
  });
}

// Returns the fields of a row of evidence, without its name, under the keys of
// properties/campaign/ledger/evidence.cpp.
template <class T>
Json facts_of(const T& evidence) {
  Json facts = Json::parse(to_row(evidence).fields);
  facts.erase("name");
  return facts;
}

// Returns, for each input of a source, the members that its row shows; null without inputs.
Json inputs_json(const RunFindings& findings, Source source) {
  Json inputs;
  for (const auto& row : findings.evidence.rows_of(source)) {
    const auto facts = facts_of(row);
    Json& input = inputs.emplace_back();
    std::istringstream words(row_of(source).shown_text);
    for (std::string word; words >> word;)
      input[word.substr(0, word.find('='))] = facts[word.substr(word.find('=') + 1)];
  }
  return inputs;
}

template <class T>
Json with_name(const char* key, const std::string& name, const T& evidence) {
  Json json = {{key, name}};
  json.update(facts_of(evidence));
  return json;
}

Json fault_json(const properties::FaultProof& proof) {
  Json fault = with_name("fault", proof.fault, proof);
  const auto* registered = properties::find_fault(proof.fault);
  fault["about"] = registered ? Json(registered->about) : Json(nullptr);
  fault["found"] = proof.is_found();
  fault["found_at_random"] = proof.found_at_random();
  fault["median_cases"] = or_null(proof.median());
  return fault;
}

Json world_json(const properties::World& world) {
  // If the time limit ended a world, the numbers of classes and motions stand among the times only.
  const bool is_settled = world.complete || world.counterexample;
  return {{"world", world.world},
          {"complete", world.complete},
          {"classes", is_settled ? Json(world.classes) : Json(nullptr)},
          {"motions", is_settled ? Json(world.motions) : Json(nullptr)},
          {"counterexample", or_null(world.counterexample)}};
}

Json size_json(const std::string& text) {
  const auto c = corpus::parse_case(text, "stored failure");
  if (!c) return nullptr;
  const auto size = properties::size_of(c.value());
  Json json = {{"triangles", size.triangles}, {"vertices", size.vertices}, {"steps", size.steps}};
  if (properties::query_of(c.value())) json["query"] = properties::query_word(c.value());
  return json;
}

// Returns a description of the cases: sizes, contacts by view sets, tags.
Json cases_json(const RunFindings& findings) {
  const auto& [strata, counts] = std::tie(findings.tally.strata, findings.tally.counts);
  const auto distribution = [](const auto& of) -> Json {
    return {{"family", of.first},
            {"triangles", histogram(of.second.sizes)},
            {"pairs", histogram(of.second.contacts)}};
  };
  const auto set_pair = [](const auto& of) -> Json {
    return {{"sets", of.first},
            {"contacts", of.second.contacts},
            {"first_contacts", of.second.first_contacts}};
  };
  return {{"distributions", each(strata, distribution)},
          {"set_pairs", each(counts.set_pairs, set_pair)},
          {"tags", counts.tags}};
}

// Returns one {gate, asks, state, verdict, exit_code, reasons} for each gate, in their order; where
// there is one, a remedy too.
Json gates_json(const properties::Judgement& judgement) {
  return each(judgement.gates, [](const auto& result) -> Json {
    const auto& rule = properties::rule_of(result.gate);
    Json gate = {
        {"gate", rule.name},       {"asks", rule.asks},           {"state", name_of(result.state)},
        {"verdict", rule.verdict}, {"exit_code", rule.exit_code}, {"reasons", result.reasons}};
    if (!result.remedy.empty()) gate["remedy"] = result.remedy;
    return gate;
  });
}

// Returns how many bounds hold together, the risk of each, and their subject.
Json confidence_json(const RunFindings& findings) {
  return {{"family", properties::family_confidence},
          {"bounds", number_of_bounds(findings.run)},
          {"risk_of_each", risk_of_each(findings.run)},
          {"method",
           "exact one-sided bound of Clopper and Pearson; Bonferroni over strata, claims and "
           "configurations"},
          {"speaks_of",
           "the share of the named generator's cases, not of the user's meshes, on which a claim "
           "does not hold"}};
}

// Returns one object for each stratum: planned, trials, discards, distinct cases, steps, and one
// bound for each configuration.
Json strata_json(const RunFindings& findings) {
  Json list = Json::array();
  for (const auto& stratum : findings.run.plan.strata) {
    const auto& tally = findings.tally_of(stratum);
    const double bound = stratum.wanted_bound;
    list.push_back({{"family", stratum.family},
                    {"planned", findings.quota(stratum)},
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
                    {"wanted_bound", bound > 0 ? Json(bound) : Json(nullptr)},
                    {"agree", configurations_agree(findings, stratum)},
                    {"bounds", bounds_json(findings, stratum)}});
  }
  return list;
}

// Returns one object for each law: how often its premise held, how often it was close, and how
// often it was broken; null for a plug-in.
Json laws_json(const RunFindings& findings) {
  const auto& plan = findings.run.plan;
  const bool built_in = findings.run.detector.built_in;
  const auto laws = properties::laws_in(findings.tally.counts, built_in);
  if (plan.laws_every == 0 || plan.strata.empty() || laws.empty()) return nullptr;
  Json list = Json::array();
  for (const auto& [law, tally] : laws) {
    const auto premise = [](const auto& one) -> Json {
      return {{"culling", one.first}, {"premises", one.second}};
    };
    list.push_back({{"law", law->name},
                    {"number", law->number},
                    {"premises", tally.premise},
                    {"by_culling", each(properties::premises_by_culling(tally, *law), premise)},
                    {"close", tally.close},
                    {"broken", tally.broken},
                    {"differs", tally.differs}});
  }
  return {{"wanted_premises", findings.laws_are_judged() ? plan.law_premises : 0},
          {"laws", std::move(list)}};
}

// Returns the largest of each extreme that was tried, and how many trials have a relation; null for
// a run of queries alone.
Json tried_json(const RunFindings& findings) {
  if (properties::asks_queries_alone(findings.run.plan)) return nullptr;
  return {{"largest", properties::json_of_fields<Json>(properties::largest_tried(findings))},
          {"relations", findings.tally.counts.measures.relation_trials}};
}

// Returns the canaries, the planted faults and the proved worlds.
Json power_json(const RunFindings& findings) {
  const auto& power = findings.evidence.power;
  return {{"canaries", each(findings.evidence.canaries, facts_of<properties::Canary>)},
          {"taken_from", power.empty() ? Json(nullptr) : facts_of(power.front())},
          {"planted", findings.faults()},
          {"found", findings.finds()},
          {"found_at_random", findings.found_at_random()},
          {"found_by_curated_case_alone", findings.finds() - findings.found_at_random()},
          {"faults", each(findings.evidence.faults, fault_json)},
          {"worlds", each(findings.evidence.worlds, world_json)}};
}

// Returns the results of the self-test; null if none was run.
Json self_test_json(const RunFindings& findings) {
  auto families = inputs_json(findings, Source::self_test);
  if (families.is_null()) return nullptr;
  const auto sum = findings.evidence.sum_of(Source::self_test);
  return {{"queries", sum.cases},
          {"contradictions", sum.defects},
          {"complete", sum.complete},
          {"families", std::move(families)}};
}

// Returns how many cases the search asked, and its results; null if the campaign has no search.
Json search_json(const RunFindings& findings) {
  const auto cases = findings.shares_of(findings.run.plan.search);
  if (cases == 0) return nullptr;
  const auto sum = findings.evidence.sum_of(Source::search);
  return {{"planned", cases},
          {"lanes", findings.evidence.rows_of(Source::search).size()},
          {"cases", sum.cases},
          {"defects", sum.defects},
          {"found", std::ranges::count(findings.kinds(), Source::search,
                                       &properties::FailureRecord::source)},
          {"causes", sum.causes}};
}

// Returns the facts that differ from one run to the next: times, and disturbed trials.
Json times_json(const RunFindings& findings) {
  const auto& [issued, speed] = std::tie(findings.evidence.issued, findings.evidence.speed);
  const bool is_issued = issued && !issued->at.empty();
  const auto figure = [](const auto& of) { return with_name("what", of.name, of); };
  const auto stratum = [](const auto& of) -> Json {
    return {{"family", of.first},
            {"oracle_us", of.second.oracle_us},
            {"detector_us", of.second.detector_us},
            {"disturbed", of.second.disturbed}};
  };
  const auto world = [](const auto& of) -> Json {
    return {{"world", of.world}, {"classes", of.classes}, {"all", of.all}, {"motions", of.motions}};
  };
  return {
      {"issued", is_issued ? Json(issued->at) : Json(nullptr)},
      {"seconds", is_issued ? Json(issued->seconds) : Json(nullptr)},
      {"speed", each(speed, figure)},
      {"strata", each(findings.tally.strata, stratum)},
      {"near_the_limit", findings.tally.near_limit.size()},
      {"worlds", each(findings.evidence.worlds, world)},
      // The digests of the stores stand here, because stores hold times, so that their bytes differ
      // from run to run.
      {"files", fields_of_each(findings.files)}};
}

// Returns one object for each signature of a defect or of a broken law, with the line that replays
// it.
Json failures_json(const RunFindings& findings) {
  Json list = Json::array();
  for (const auto* failure : findings.kinds()) {
    const bool is_shrunk = !failure->smallest.empty();
    const auto name = properties::failure_file(*failure, is_shrunk);
    const auto& mesh = is_shrunk ? failure->smallest : failure->mesh;
    list.push_back({{"signature", failure->signature()},
                    {"claim", failure->rule()},
                    {"configuration", failure->shown_configuration()},
                    {"met", findings.met_count(*failure)},
                    {"flaky", failure->flaky},
                    {"what", failure->shown_explanation()},
                    {"case", failure->id()},
                    {"before", size_json(failure->mesh)},
                    {"after", is_shrunk ? size_json(failure->smallest) : Json(nullptr)},
                    {"file", name.generic_string()},
                    {"sha256", corpus::sha256_of(mesh)},
                    {"replay", "assay " + replay_words("", name, detector_of(findings))}});
  }
  return list;
}

// Returns the signatures by groups (properties/campaign/gates/gates.h).
Json failure_groups_json(const RunFindings& findings) {
  const auto kinds = findings.kinds().size();
  return each(properties::failure_groups(findings), [&](const auto& group) -> Json {
    return {{"what", properties::text_of(group, kinds)},
            {"kinds", group.kinds},
            {"smallest", group.smallest}};
  });
}

// Returns the isolation that held in every run.
Json isolation_json(const RunFindings& findings) {
  if (findings.run.detector.built_in) return nullptr;
  const auto& rows = findings.evidence.isolation;
  const auto is_behind_bubblewrap = [](const properties::PluginIsolation& run) {
    return run.got == name_of(properties::Isolation::bubblewrap);
  };
  return text_of(!rows.empty() && std::all_of(rows.begin(), rows.end(), is_behind_bubblewrap)
                     ? properties::Isolation::bubblewrap
                     : properties::Isolation::limits);
}

Json versions_json(const RunFindings& findings) {
  const auto& versions = findings.evidence.versions;
  if (!versions) return nullptr;
  return {{"assay", versions->assay},
          {"commit", or_null(versions->commit)},
          {"libraries", versions->libraries}};
}

Json digests_json(const RunFindings& findings, const std::string& campaign) {
  const auto& versions = findings.evidence.versions;
  Json json = json_of(findings.run.digests);
  json["corpus"] = versions ? Json(versions->corpus) : Json(nullptr);
  json["campaign"] = campaign;
  json["rows"] = findings.rows;
  return json;
}

std::string share_text(const properties::RunPart& part) { return fmt::format("1/{}", part.shares); }

Json campaign_json(const RunFindings& findings, const properties::CampaignPlan& plan) {
  const auto part_json = [](const auto& part) -> Json {
    return {{"seed", part.seed}, {"share", share_text(part)}, {"rows", part.rows}};
  };
  return {{"name", plan.name},
          {"seed", findings.parts.front().seed},
          {"is_default_seed",
           std::any_of(findings.parts.begin(), findings.parts.end(),
                       [](const auto& part) { return part.seed == properties::default_seed; })},
          {"plan", Json::parse(plan_text(plan))},
          {"parts", each(findings.parts, part_json)},
          {"is_whole", findings.is_whole()},
          {"planted_faults", findings.run.planted_faults}};
}

Json replay_json(const RunFindings& findings) {
  const auto& paths = findings.evidence.issued;
  if (!paths) return Json::array();
  std::string folders =
      paths->own_cases.empty() ? "" : fmt::format(" --corpus {}", shell_word(paths->own_cases));
  auto words = detector_of(findings);
  words.library = paths->detector;
  if (!paths->data.empty()) folders += fmt::format(" --data {}", shell_word(paths->data));
  Json lines = Json::array();
  for (const auto& part : findings.parts)
    lines.push_back(fmt::format("assay {} --campaign {} --seed {}{}{} --out AGAIN{}",
                                part.shares == 1 ? "certify" : "run --share " + share_text(part),
                                properties::campaign_file("").string(), part.seed,
                                detector_words(words), folders,
                                findings.parts.size() == 1 ? "" : fmt::format("/{}", part.seed)));
  if (findings.parts.size() > 1) lines.push_back("assay verify AGAIN/* --out AGAIN-ALL");
  lines.push_back(fmt::format("assay verify {}", properties::certificate_file("").string()));
  return lines;
}

// Tells paths for readers of other machines, and replaces what is not UTF-8, such as in the name of
// a folder. The result equals the JSON that is read back from the file.
Json for_any_reader(const RunFindings& findings, Json predicate) {
  RunPaths(findings).tell_in(predicate);
  return Json::parse(corpus::json_text(predicate));
}

}  // namespace

Json make_predicate(const RunFindings& findings, const properties::Judgement& judgement,
                    const properties::CampaignPlan& plan, const std::string& campaign_digest) {
  Json problems = Json::array();
  for (const auto& problem : findings.evidence.problems) {
    if (!problem.what.empty()) problems.push_back(problem.what);
  }
  Json predicate = {
      {"schema", certificate_schema},
      {"verdict", judgement.verdict},
      {"exit_code", judgement.exit_code},
      {"failed_gate", judgement.failed_gate ? Json(properties::rule_of(*judgement.failed_gate).name)
                                            : Json(nullptr)},
      {"gates", gates_json(judgement)},
      {"detector", json_of(findings.run.detector)},
      {"not_judged", fields_of_each(properties::not_judged(findings))},
      {"judged_up_to", fields_of_each(properties::judged_sizes(findings))},
      {"tried", tried_json(findings)},
      {"left_out_families", properties::left_out_families(findings)},
      {"isolation", isolation_json(findings)},
      {"versions", versions_json(findings)},
      {"campaign", campaign_json(findings, plan)},
      {"confidence", confidence_json(findings)},
      {"strata", strata_json(findings)},
      {"cases", cases_json(findings)},
      {"laws", laws_json(findings)},
      {"power", power_json(findings)},
      {"harness_problems", std::move(problems)},
      {"self_test", self_test_json(findings)}};
  for (const auto& row : properties::all_rows<Source>)
    if (*row.section)
      predicate[row.section] =
          *row.shown_text ? inputs_json(findings, row.value) : search_json(findings);
  predicate.update(Json{{"failures", failures_json(findings)},
                        {"failure_groups", failure_groups_json(findings)},
                        {"replay", replay_json(findings)},
                        {"digests", digests_json(findings, campaign_digest)},
                        {"times", times_json(findings)}});
  return for_any_reader(findings, std::move(predicate));
}

}  // namespace assay::reports
