// What the steps of a plug-in come to under `check`: its claims, and what it does whatever it
// claims.
#pragma once

#include "properties/worker/plugin/plugin_description.h"
#include "reports/check/check_outcome.h"

namespace assay::reports {

class ClaimsTally {
 public:
  // `plugin` is null for the built-in detector, for which nothing is counted.
  explicit ClaimsTally(const properties::PluginDescription* plugin) : plugin_(plugin) {}

  void add(const properties::StepDiff& diff, const detector::StepResult& result);
  // Writes the result into `outcome`. `steps_left_out` is the number of steps of the input that
  // the contract leaves out.
  void tell(CheckOutcome& outcome, std::size_t steps_left_out) const;

 private:
  const properties::PluginDescription* plugin_;
  properties::StepMeasures measures_;
};

}  // namespace assay::reports
