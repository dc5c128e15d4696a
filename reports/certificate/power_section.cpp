#include <fmt/format.h>

#include <set>

#include "corpus/cases/case_file.h"
#include "corpus/digest.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/faults/fault.h"
#include "properties/reducer/mesh_size.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/campaign/failure_text.h"
#include "reports/certificate/sections.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;
using properties::RunFindings;

// What the row of a piece of evidence says of it, under the keys of
// properties/campaign/ledger/evidence.cpp; but not its name.
template <class T>
Json facts_of(const T& evidence) {
  Json facts = Json::parse(to_row(evidence).fields);
  facts.erase("name");
  return facts;
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

}  // namespace

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

Json corpus_json(const RunFindings& findings) {
  if (findings.evidence.corpus.empty()) return nullptr;
  Json rows = Json::array();
  for (const auto& row : findings.evidence.corpus) rows.push_back(facts_of(row));
  return rows;
}

Json repeated_json(const RunFindings& findings) {
  if (findings.evidence.repeated.empty()) return nullptr;
  Json rows = Json::array();
  for (const auto& row : findings.evidence.repeated) rows.push_back(facts_of(row));
  return rows;
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

namespace {

Json size_json(const std::string& text) {
  const auto c = corpus::parse_case(text, "stored failure");
  if (!c) return nullptr;
  const auto size = properties::size_of(c.value());
  Json json = {{"triangles", size.triangles}, {"vertices", size.vertices}, {"steps", size.steps}};
  if (properties::query_of(c.value())) json["query"] = properties::query_word(c.value());
  return json;
}

}  // namespace

Json failures_json(const properties::RunFindings& findings) {
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

}  // namespace assay::reports
