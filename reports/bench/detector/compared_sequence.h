// A sequence of steps, run by a plug-in and by the built-in detector: the time that each took, and
// what was wrong with the plug-in's answers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "properties/claims/claims.h"
#include "properties/worker/isolation/isolation.h"
#include "reports/bench/estimate.h"

namespace assay::reports {

// One time of both, measured in turn.
struct ComparedTime {
  Estimate plugin_ms, built_in_ms;
  Estimate over;  // the plug-in's over the built-in's, round by round
};

// First times that are off: in how many steps, and by which share of the step at worst. Counted
// whatever is tolerated.
struct FirstTimesOff {
  std::uint64_t steps = 0;
  double worst = 0;
};

// The plug-in's errors against the oracle, under its own contract. Numbers are of steps, unless
// said otherwise.
struct PluginErrors {
  std::uint64_t judged = 0;     // steps that the contract takes
  std::uint64_t contact = 0;    // of the judged ones: with a contact that counts
  std::uint64_t undecided = 0;  // without an answer: undecided or an error
  // The answer is `free` although there is a contact, the first time is late by more than is
  // tolerated, or a claimed pair is missing.
  std::uint64_t unsafe = 0;
  std::uint64_t missed = 0;  // of the unsafe ones: `free`, although there is a contact
  std::uint64_t false_alarms = 0;
  std::uint64_t missing = 0, spurious = 0;  // pairs
  FirstTimesOff late, early;
  std::vector<std::string> broken;  // claims, each once
};

struct ComparedSequence {
  std::string name, kind;  // kind: scene, real
  std::uint64_t triangles = 0, steps = 0;
  std::uint64_t left_out = 0;  // steps that the contract does not take
  // How the plug-in's run ended, if it has no times: "hung: ...", "crashed: ...".
  std::string ended;
  std::optional<ComparedTime> step, create;  // a step on average; preprocessing
  PluginErrors errors;
};

// The plug-in that was timed.
struct ComparedDetector {
  std::string name, version, library;
  properties::Claims claims;  // on steps
  properties::Contract contract;
  properties::Isolation isolation;
  std::uint64_t threads = 1;
};

}  // namespace assay::reports
