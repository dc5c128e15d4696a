// What a run found out besides its trials, as rows of its store. Facts hold no times: those are
// evidence of kind "times".
//
// kind (name): facts
//   canary (fault): found_after
//   problem (trials): what
//   fault (fault): law, status, curated, needed, cases, time_over, known_vertices, shrunk
//   world (world): classes, motions, all, collisions, complete, counterexample
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "properties/campaign/campaign_facts.h"
#include "properties/tetrahedron_world.h"

namespace assay::reports {

void store_canary(properties::Store& store, const std::string& shard,
                  const properties::CanaryResult& canary);

// Of this run; an empty one takes an earlier one away.
void store_harness_problem(properties::Store& store, const std::string& shard,
                           const std::string& problem);

void store_faults(properties::Store& store, const std::string& shard,
                  const properties::FaultHunt& hunt,
                  const std::vector<properties::FaultResult>& results, bool had_time);

void store_world(properties::Store& store, const std::string& shard,
                 const properties::TetrahedronWorld& world,
                 const properties::TetrahedronWorldResult& result);

// Facts as `assay certify` finds them out by itself: in the shard "checks".
void store_check(properties::Store& store, const std::string& kind, const std::string& name,
                 const nlohmann::ordered_json& facts);

}  // namespace assay::reports
