#include "reports/certificate/fault_facts.h"
#include "reports/certificate/sections.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

Json canaries_json(const Findings& findings) {
  Json list = Json::array();
  for (const auto& row : findings.of("canary")) {
    const auto facts = Json::parse(row.facts);
    list.push_back(
        {{"fault", row.name}, {"shard", row.shard}, {"found_after", facts["found_after"]}});
  }
  return list;
}

}  // namespace

Json power_json(const Findings& findings) {
  Json faults = Json::array();
  std::uint64_t planted = 0, found = 0;
  for (const auto& row : findings.of("fault")) {
    auto facts = Json::parse(row.facts);
    const bool is_planted = facts["status"] == "planted";
    planted += is_planted ? 1 : 0;
    found += is_planted && is_found(facts) ? 1 : 0;
    faults.push_back({{"fault", row.name},
                      {"law", facts["law"]},
                      {"status", facts["status"]},
                      {"found", is_found(facts)},
                      {"median_cases", median_of_needed(facts["needed"])},
                      {"needed", facts["needed"]},
                      {"cases", facts["cases"]},
                      {"time_over", facts["time_over"]},
                      {"curated", facts["curated"]},
                      {"known_vertices", facts["known_vertices"]},
                      {"shrunk", facts["shrunk"]}});
  }
  Json worlds = Json::array();
  for (const auto& row : findings.of("world")) {
    // Of one that the time ended only the times tell how far it came.
    const auto facts = Json::parse(row.facts);
    const bool is_settled = facts["complete"].get<bool>() || !facts["counterexample"].is_null();
    worlds.push_back({{"world", row.name},
                      {"complete", facts["complete"]},
                      {"classes", is_settled ? facts["classes"] : Json(nullptr)},
                      {"motions", is_settled ? facts["motions"] : Json(nullptr)},
                      {"counterexample", facts["counterexample"]}});
  }
  return {{"canaries", canaries_json(findings)},
          {"planted", planted},
          {"found", found},
          {"faults", std::move(faults)},
          {"worlds", std::move(worlds)}};
}

Json self_test_json(const Findings& findings) {
  Json families = Json::array();
  std::uint64_t queries = 0, contradictions = 0;
  bool complete = true;
  for (const auto& row : findings.of("self-test")) {
    auto facts = Json::parse(row.facts);
    queries += facts["queries"].get<std::uint64_t>();
    contradictions += facts["contradictions"].get<std::uint64_t>();
    complete &= facts["complete"].get<bool>();
    Json family = {{"family", row.name}};
    family.update(facts);
    families.push_back(std::move(family));
  }
  if (families.empty()) return nullptr;
  return {{"queries", queries},
          {"contradictions", contradictions},
          {"complete", complete},
          {"families", std::move(families)}};
}

Json corpus_json(const Findings& findings) {
  Json rows = Json::array();
  for (const auto& row : findings.of("corpus")) rows.push_back(Json::parse(row.facts));
  return rows.empty() ? Json(nullptr) : rows;
}

Json times_json(const Findings& findings) {
  Json times = {{"issued", nullptr}, {"seconds", nullptr}, {"speed", Json::array()}};
  for (const auto& row : findings.of("times")) {
    const auto facts = Json::parse(row.facts);
    if (row.name == "issued") {
      times["issued"] = facts["at"];
      times["seconds"] = facts["seconds"];
    } else {
      times["speed"].push_back(facts);
    }
  }
  Json strata = Json::array();
  for (const auto& [family, tally] : findings.tally.strata) {
    strata.push_back(
        {{"family", family}, {"oracle_us", tally.oracle_us}, {"detector_us", tally.detector_us}});
  }
  times["strata"] = std::move(strata);
  Json worlds = Json::array();
  for (const auto& row : findings.of("world")) {
    const auto facts = Json::parse(row.facts);
    worlds.push_back({{"world", row.name},
                      {"classes", facts["classes"]},
                      {"all", facts["all"]},
                      {"motions", facts["motions"]}});
  }
  times["worlds"] = std::move(worlds);
  // Stores hold times, so the bytes of their files differ from run to run.
  Json files = Json::array();
  for (const auto& file : findings.files)
    files.push_back({{"name", file.name}, {"sha256", file.sha256}});
  times["files"] = std::move(files);
  return times;
}

}  // namespace assay::reports
