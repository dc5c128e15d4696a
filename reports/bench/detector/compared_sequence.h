// A sequence of steps by a plug-in and by the built-in detector: what each took, and what was wrong
// with the plug-in's answers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "properties/claims/claims.h"
#include "properties/worker/isolation/isolation.h"
#include "reports/bench/estimate.h"

namespace assay::reports {

// One figure of both, measured in turn.
struct ComparedTime {
  Estimate plugin_ms, built_in_ms;
  Estimate over;  // the plug-in's over the built-in's, round by round
};

// Of a first time that is off: in how many steps, and by which share of the step at worst, whatever
// is tolerated.
struct FirstTimesOff {
  std::uint64_t steps = 0;
  double worst = 0;
};

// Against the oracle, under the plug-in's contract. Where not said otherwise, steps.
struct PluginErrors {
  std::uint64_t judged = 0;     // those that the contract takes
  std::uint64_t contact = 0;    // of these, with a contact that counts
  std::uint64_t undecided = 0;  // without an answer: undecided, or an error
  // `free` against a contact, late by more than is tolerated, or a claimed pair missing.
  std::uint64_t unsafe = 0;
  std::uint64_t missed = 0;  // of these, `free` against a contact
  std::uint64_t false_alarms = 0;
  std::uint64_t missing = 0, spurious = 0;  // pairs
  FirstTimesOff late, early;
  std::vector<std::string> broken;  // claims, each once
};

struct ComparedSequence {
  std::string name, kind;  // kind: scene, real
  std::uint64_t triangles = 0, steps = 0;
  std::uint64_t left_out = 0;  // steps that the contract does not take
  // How the plug-in's run ended where it has no times: "hung: ...", "crashed: ...".
  std::string ended;
  std::optional<ComparedTime> step, create;  // of a step on average; of preprocessing
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
