// A case through one detector in a worker, again and again: what it took, and its first run, which
// is judged.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "properties/worker/worker_process.h"

namespace assay::reports {

// Nothing is run again after a run that did not complete, nor after a first one with a step of more
// than `longest_repeated` seconds.
struct TimedRuns {
  double longest_repeated = HUGE_VAL;

  std::optional<properties::CaseRun> first;
  std::vector<double> create_ms;  // without that of the first run, unless it is the only one
  std::vector<double> ms_a_step;  // the same
  std::string ended;              // of a run that did not complete, in words
  bool is_once = false;           // the first run is the only one: of every round it is told
  bool has_differing_runs = false;

  // One more run; milliseconds a step, 0 where there are none.
  double run_once(properties::WorkerProcess& worker, const corpus::Case& c,
                  const properties::Configuration& configuration);
};

}  // namespace assay::reports
