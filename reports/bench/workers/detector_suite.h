// Times a plug-in beside the built-in detector, on the same steps of scenes and public sequences.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "properties/judging/step_errors.h"
#include "properties/judging/subject.h"
#include "reports/bench/suites.h"

namespace assay::reports {

// One time of both, measured in turn.
struct ComparedTime {
  Estimate plugin_ms, built_in_ms;
  Estimate over;  // the plug-in's over the built-in's, round by round
};

void to_json(nlohmann::ordered_json& json, const ComparedTime& time);

// A sequence of steps, run by both: the time that each took, and what was wrong with the plug-in's
// answers.
struct ComparedSequence {
  std::string name, kind;  // kind: scene, real
  std::uint64_t triangles = 0, steps = 0;
  std::uint64_t left_out = 0;  // steps that the contract does not take
  // How the plug-in's run ended, if it has no times: "hung: ...", "crashed: ...".
  std::string ended;
  std::optional<ComparedTime> step, create;  // a step on average; preprocessing
  properties::StepErrors errors;             // under the plug-in's contract
  std::vector<std::string> broken;           // claims, each once
};

// Each detector runs in a worker of its own, in turn, a whole sequence each time. The times
// reported are those of that process's own clock, with all of its threads. The built-in detector
// is set to answer what the plug-in claims: all pairs, or those of the first contact; and it
// verifies the start if the plug-in's contract takes any start.
//
// The oracle judges the plug-in's first answers by its claims under its contract. A broken claim
// is a wrong answer of the report, and so is anything that the built-in detector has wrong. There
// are no times for a sequence that the contract does not take, or on which the plug-in's run ends
// early; the row says so. With a scale below 1, public sequences of more than 10,000 triangles are
// left out. `sequences`, if given, gets what the rows tell.
//
// REQUIRES a plug-in that has steps. `limits.seconds` of it is the processor time that one run of a
// sequence may take.
BenchReport detector_suite(const BenchSettings& settings, const properties::Subject& plugin,
                           const BenchProgress& progress,
                           std::vector<ComparedSequence>* sequences = nullptr);

}  // namespace assay::reports
