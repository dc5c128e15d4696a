// One trial: a case through a detector's configurations, judged by the oracle once.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "properties/campaign/trials/failure.h"
#include "properties/judging/judged_run.h"

namespace assay::properties {

// A detector, its claims, and the configurations in which it is certified.
struct DetectorUnderTest {
  std::string name;
  bool built_in = true;
  Claims claims;  // of a plug-in; the built-in claims by its configuration's options
  Contract contract;
  std::vector<Configuration> configurations;
  bool of_queries = false;  // of a plug-in: its elementary query is judged, and nothing else

  Claims claims_in(const Configuration& configuration) const;
};

// Every culling built so far with pairs all, and the view cullings with pairs first and in bounded
// arithmetic.
DetectorUnderTest built_in_detector();

struct JudgedTrial {
  Outcome outcome = Outcome::holds;
  std::optional<Failure> failure;   // of a defect: the first step that shows one
  std::size_t left_out_misses = 0;  // steps that only the contract saves from being a miss
  std::vector<StepDiff> steps;      // of a completed run
};

// truth: of the same case, contracted (judged_run.h). again: a second run, if there was one. The
// built-in detector's times in exact arithmetic must be the oracle's in every bit; a plug-in is
// judged by its claims.
JudgedTrial judge_trial(const corpus::Case& c, std::span<const oracle::StepJudgement> truth,
                        const CaseRun& run, const Configuration& configuration,
                        const DetectorUnderTest& detector, const CaseRun* again = nullptr);

}  // namespace assay::properties
