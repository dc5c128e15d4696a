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
  Claims claims;  // of a plug-in; for the built-in detector see claims_in
  Contract contract;
  std::vector<Configuration> configurations;
  bool of_queries = false;  // only the elementary query of a plug-in is judged
  // What a plug-in claims of its elementary query; nothing if that is not judged.
  Claims query_claims{};
  // The parts that the library holds and that are not judged, in words: "elementary query".
  std::vector<std::string> unjudged_parts{};

  Claims claims_in(const Configuration& configuration) const;
  // What it claims of this case, which may be a query (query_case.h).
  Claims claims_on(const corpus::Case& c, const Configuration& configuration) const;
};

// The built-in detector with every culling and pairs all, and the view cullings with pairs first
// and in bounded arithmetic.
DetectorUnderTest built_in_detector();

struct JudgedTrial {
  Outcome outcome = Outcome::holds;
  std::optional<Failure> failure;   // for a defect: the first step that shows one
  std::size_t left_out_misses = 0;  // steps that only the contract saves from being a miss
  std::vector<StepDiff> steps;      // only of a completed run
};

// Judges one run of a case. `truth` is the oracle's judgement of the same case, contracted
// (judged_run.h); `again` is a second run, if there was one. In exact arithmetic the built-in
// detector's times must be the oracle's in every bit; a plug-in is judged by its claims.
JudgedTrial judge_trial(const corpus::Case& c, std::span<const oracle::StepJudgement> truth,
                        const CaseRun& run, const Configuration& configuration,
                        const DetectorUnderTest& detector, const CaseRun* again = nullptr);

}  // namespace assay::properties
