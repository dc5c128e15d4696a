// What a run found out besides its trials (reports/certificate/evidence.h), as the page shows it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "properties/campaign/runner.h"

namespace assay::reports {

// Keeps the path of a plug-in's library, as it was named to the run, for replay lines and for the
// page. Throws StoreProblem.
void note_library(properties::Store& store, const properties::CampaignRequest& request);
// Empty where it was not kept, or for the built-in detector.
std::string noted_library(const properties::Store& store);

// Fields of assay-report/1, of one store or several.
struct RunEvidence {
  nlohmann::ordered_json canary;  // {fault, found_after}, the worst of all shards; null: none met
  nlohmann::ordered_json faults;  // a list, or null where none were planted
  nlohmann::ordered_json worlds = nlohmann::ordered_json::array();
  std::vector<std::string> problems;  // of the harness, a line each

  // Throws nlohmann's exceptions on facts that no run stores.
  void add(const properties::Evidence& evidence);
};

}  // namespace assay::reports
