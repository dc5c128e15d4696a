// Paths as they are told to readers who have none of the folders of the machine that a run was made
// on.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>

#include "properties/campaign/gates/findings.h"

namespace assay::reports {

// Lines are for the run's own folder, as it was when the run was stored. A path is told as it goes
// from there, or by its last name where it goes through the root.
class ToldPaths {
 public:
  explicit ToldPaths(const properties::RunFindings& findings);
  std::string told(const std::string& path) const;
  // Tells all paths so in each text of `json`.
  void tell_in(nlohmann::ordered_json& json) const;

 private:
  void tell_in(std::string& text) const;
  std::string folder_;                            // ends with a slash; empty: the root
  std::set<std::string, std::greater<>> others_;  // a folder after what lies in it
};

}  // namespace assay::reports
