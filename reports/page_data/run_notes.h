// What a run writes into its store for those who read it later: its detector, its planted faults.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "properties/campaign/campaign_facts.h"

namespace assay::reports {

// Throw StoreProblem.
void note_detector(properties::Store& store, const properties::CampaignRequest& request);
void note_canary(properties::Store& store, const properties::CanaryResult& canary);
void note_faults(properties::Store& store, const std::vector<properties::FaultResult>& results);

// How a run ended. Noted as `unfinished` when it begins.
struct RunEndNote {
  std::string outcome = "unfinished";
  std::vector<std::string> harness;  // what the harness owes and does not deliver, a line each
  bool bounds_met = false;  // wanted ones; where none is wanted: nothing was left undecided
};
void note_end(properties::Store& store, const RunEndNote& end);

struct DetectorNote {
  std::string name;
  bool built_in = true;
  std::string library;  // of a plug-in, as it was named to the run
  std::vector<std::string> configurations;
};

// Nothing in a store that has no such note, or one that is not understood.
std::optional<DetectorNote> noted_detector(const properties::Store& store);
std::optional<RunEndNote> noted_end(const properties::Store& store);
// A list, or null: see `faults` of assay-report/1.
nlohmann::ordered_json noted_faults(const properties::Store& store);
// {fault, found_after} or null.
nlohmann::ordered_json noted_canary(const properties::Store& store);

}  // namespace assay::reports
