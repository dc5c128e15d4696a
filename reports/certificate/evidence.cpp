#include "reports/certificate/evidence.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "properties/campaign/binding.h"
#include "properties/reducer/mesh_size.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::optional<std::uint64_t>& number) {
  return number ? Json(*number) : Json(nullptr);
}

Json mesh_json(const corpus::Case& c) {
  const auto size = properties::size_of(c);
  return {{"triangles", size.triangles}, {"vertices", size.vertices}, {"steps", size.steps}};
}

}  // namespace

void store_canary(properties::Store& store, const std::string& shard,
                  const properties::CanaryResult& canary) {
  store.set({"canary", canary.fault, shard, 1,
             Json{{"found_after", json_of(canary.found_after)}}.dump()});
}

void store_harness_problem(properties::Store& store, const std::string& shard,
                           const std::string& problem) {
  store.drop_evidence("problem");
  if (!problem.empty()) store.set({"problem", "trials", shard, 1, Json{{"what", problem}}.dump()});
}

void store_faults(properties::Store& store, const std::string& shard,
                  const properties::FaultHunt& hunt,
                  const std::vector<properties::FaultResult>& results, bool had_time) {
  for (const auto& result : results) {
    const auto& fault = *result.fault;
    Json needed = Json::array();
    std::uint64_t found = 0;
    for (const auto& cases : result.needed) {
      needed.push_back(json_of(cases));
      found += cases ? 1 : 0;
    }
    Json shrunk = nullptr;
    if (result.reduction && result.shown_by) {
      shrunk = {{"before", mesh_json(*result.shown_by)},
                {"after", mesh_json(result.reduction->smallest)},
                {"calls", result.reduction->calls}};
    }
    const Json facts = {{"law", fault.law},
                        {"status", properties::name_of(fault.status)},
                        {"curated", result.by_curated},
                        {"needed", std::move(needed)},
                        {"cases", hunt.cases},
                        {"time_over", !had_time},
                        {"known_vertices", fault.smallest_vertices},
                        {"shrunk", std::move(shrunk)}};
    const auto all = static_cast<std::uint64_t>(hunt.seeds) + 1;
    store.set({"fault", std::string(fault.name), shard, had_time ? all : std::min(found, all - 1),
               facts.dump()});
  }
}

void store_world(properties::Store& store, const std::string& shard,
                 const properties::TetrahedronWorld& world,
                 const properties::TetrahedronWorldResult& result) {
  // A counterexample is farther than any number of classes that hold.
  constexpr std::uint64_t found = std::numeric_limits<std::int64_t>::max();
  store.set({"world", std::string(world.name), shard,
             result.counterexample ? found : result.classes,
             Json{{"classes", result.classes},
                  {"motions", result.motions},
                  {"all", result.all},
                  {"collisions", result.collisions},
                  {"complete", result.complete},
                  {"counterexample", result.counterexample ? Json(result.what) : Json(nullptr)}}
                 .dump()});
}

void store_check(properties::Store& store, const std::string& kind, const std::string& name,
                 const nlohmann::ordered_json& facts) {
  store.set({kind, name, properties::checks_shard, 1, facts.dump()});
}

}  // namespace assay::reports
