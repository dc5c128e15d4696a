// Runs a case through one detector in a worker again and again. Keeps the times, and the first
// run, which is judged.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "properties/worker/worker_process.h"

namespace assay::reports {

// The case is not run again after a run that did not complete, nor if the first run had a step of
// more than `longest_repeated` seconds.
struct TimedRuns {
  double longest_repeated = HUGE_VAL;

  std::optional<properties::CaseRun> first;
  std::vector<double> create_ms;  // without the first run, unless it is the only one
  std::vector<double> ms_a_step;  // as create_ms
  std::string ended;              // how a run ended that did not complete, in words
  bool is_once = false;           // the first run is the only one, and stands for every round
  bool has_differing_runs = false;

  // Makes one more run. Returns milliseconds a step, 0 if there are none.
  double run_once(properties::WorkerProcess& worker, const corpus::Case& c,
                  const properties::Configuration& configuration);
};

}  // namespace assay::reports
