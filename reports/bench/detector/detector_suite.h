// A plug-in beside the built-in detector, on the same steps of scenes and public sequences.
#pragma once

#include <cstdint>
#include <string>

#include "properties/worker/worker_process.h"
#include "reports/bench/suites.h"

namespace assay::reports {

// The plug-in that is timed; it has steps.
struct BenchedPlugin {
  std::string library;
  properties::PluginDescription description;
  // `seconds`: processor time of one run of a sequence at most.
  properties::WorkerLimits limits;
  int jobs = 1;  // threads of the oracle
};

// Each runs in a worker of its own, in turn, a whole sequence a time: what is told is what they
// took there by that process's own clock, with all of its threads. The built-in detector answers
// what the plug-in claims: all pairs, or those of the first contact; and it verifies the start
// where the plug-in's contract takes any.
//
// The oracle judges the plug-in's first answers by its claims under its contract. A claim that is
// broken is a wrong answer of the report, and so is anything that the built-in detector has wrong.
// A sequence that the contract does not take has no times, nor has one on which the plug-in's run
// ends early: the row says so. With a scale below 1 public sequences of more than 10,000
// triangles are left out.
BenchReport detector_suite(const BenchSettings& settings, const BenchedPlugin& plugin,
                           Progress& progress);

}  // namespace assay::reports
