#include "reports/page_data/run_evidence.h"

#include "properties/faults/fault.h"
#include "reports/certificate/fault_facts.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* library_key = "library";

Json shrunk_json(const Json& shrunk) {
  if (shrunk.is_null()) return nullptr;
  const auto &before = shrunk.at("before"), &after = shrunk.at("after");
  return {{"from_triangles", before.at("triangles")},
          {"from_steps", before.at("steps")},
          {"vertices", after.at("vertices")},
          {"triangles", after.at("triangles")},
          {"steps", after.at("steps")},
          {"calls", shrunk.at("calls")}};
}

Json fault_json(const std::string& name, const Json& facts) {
  const auto* fault = properties::find_fault(name);
  const auto& needed = facts.at("needed");
  const bool has_case = !fault || !fault->curated.empty();
  const auto& known = facts.at("known_vertices");
  return {{"name", name},
          {"about", fault ? Json(fault->about) : Json()},
          {"law", facts.at("law")},
          {"status", facts.at("status")},
          {"found", is_found(facts)},
          {"time_over", facts.at("time_over")},
          {"median_cases", median_of_needed(needed)},
          {"cases", needed},
          {"by_curated", has_case ? facts.at("curated") : Json()},
          {"known_vertices", known == 0 ? Json() : known},
          {"shrunk", shrunk_json(facts.at("shrunk"))}};
}

// Not found is worse than any number of cases.
bool is_worse(const Json& canary, const Json& than) {
  if (than.is_null()) return true;
  if (than.at("found_after").is_null()) return false;
  return canary.at("found_after").is_null() || canary["found_after"] > than["found_after"];
}

}  // namespace

void note_library(properties::Store& store, const properties::CampaignRequest& request) {
  if (request.plugin) store.set_note(library_key, request.plugin->string());
}

std::string noted_library(const properties::Store& store) {
  return store.note(library_key).value_or("");
}

void RunEvidence::add(const properties::Evidence& evidence) {
  const Json facts = Json::parse(evidence.facts);
  if (evidence.kind == "canary") {
    const Json met = {{"fault", evidence.name}, {"found_after", facts.at("found_after")}};
    if (is_worse(met, canary)) canary = met;
  } else if (evidence.kind == "problem") {
    problems.push_back(facts.at("what"));
  } else if (evidence.kind == "fault") {
    if (faults.is_null()) faults = Json::array();
    faults.push_back(fault_json(evidence.name, facts));
  } else if (evidence.kind == "world") {
    worlds.push_back({{"world", evidence.name},
                      {"complete", facts.at("complete")},
                      {"classes", facts.at("classes")},
                      {"motions", facts.at("motions")},
                      {"counterexample", facts.at("counterexample")}});
  }
}

}  // namespace assay::reports
