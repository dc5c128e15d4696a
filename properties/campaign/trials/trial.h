// One trial: a case through a detector's configurations, judged by the oracle once.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/judging/agreement.h"
#include "properties/judging/judged_run.h"

namespace assay::properties {

// A defect of a trial: which claim it breaks, how, and where.

// A defect, described by what distinguishes it from other defects.
struct Failure {
  Claim claim = Claim::total;
  // How the claim is broken. One of these, as fits the claim: "answered free", "late", "early",
  // "missing pair", "late pair", "answered collision", "spurious pair", "early pair", "missing
  // candidate", "error", "two runs differ", "crashed", "refused".
  std::string kind;
  std::size_t step = 0;                        // step of the script
  std::optional<detector::TrianglePair> pair;  // the first wrong pair
  std::string configuration;
  std::string stage;        // the stage of the built-in detector that lost the pair
  std::string feature;      // the feature of the pair
  std::string cause;        // only of a plug-in, whose stages nobody knows (cause.h)
  std::string explanation;  // one line for people: by how much, both answers and their times

  // Claim, kind, stage, feature, cause: what a shrunk case must keep.
  std::string signature() const;
};

// What a step shows of the first claim that it breaks; configuration, stage and cause are left
// empty. REQUIRES a diff of this result that breaks a claim.
Failure failure_of(const StepDiff& diff, const detector::StepResult& result);

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
