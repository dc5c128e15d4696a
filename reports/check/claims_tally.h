// What the steps of a plug-in come to under `check`: its claims, and what it does whatever these.
#pragma once

#include "properties/worker/plugin/plugin_description.h"
#include "reports/check/check_outcome.h"

namespace assay::reports {

class ClaimsTally {
 public:
  // null: the built-in detector, of which nothing is tallied.
  explicit ClaimsTally(const properties::PluginDescription* plugin) : plugin_(plugin) {}

  void add(const properties::StepDiff& diff, const detector::StepResult& result,
           const oracle::StepJudgement& judgement);
  // `steps_left_out`: by the contract, of the input.
  void tell(CheckOutcome& outcome, std::size_t steps_left_out) const;

 private:
  const properties::PluginDescription* plugin_;
  properties::Counts counts_;
};

}  // namespace assay::reports
