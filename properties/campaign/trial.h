// One trial: a case through a detector's configurations, judged by the oracle once.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "properties/agreement.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// A detector, its claims, and the configurations in which it is certified.
struct DetectorUnderTest {
  std::string name;
  bool built_in = true;
  Claims claims;  // of a plug-in; the built-in claims by its configuration's `pairs`
  Contract contract;
  std::vector<Configuration> configurations;

  Claims claims_in(const Configuration& configuration) const;
};

// Every culling built so far with pairs all, and the view cullings with pairs first.
DetectorUnderTest built_in_detector();

// What the oracle says of each step of the case, under the contract's coordinates.
std::vector<oracle::StepJudgement> judge_steps(const corpus::Case& c,
                                               const Contract& contract = {});

// A defect, as far as it tells one defect from another.
struct Failure {
  Claim claim = Claim::total;
  std::size_t step = 0;                        // of the script
  std::optional<detector::TrianglePair> pair;  // the first that is wrong
  std::string configuration;
  std::string stage;    // that lost it
  std::string feature;  // of the pair
  std::string what;     // one line for people

  // claim, kind of difference, stage, feature: what a shrunk case must keep.
  std::string signature() const;
  std::string kind;  // "missing", "spurious", "late", "early", "answer", "crash", ...
};

struct Verdict {
  Outcome outcome = Outcome::holds;
  std::optional<Failure> failure;  // of a defect: the first step that shows one
};

Verdict judge_run(const corpus::Case& c, const std::vector<oracle::StepJudgement>& truth,
                  const CaseRun& run, const Configuration& configuration,
                  const DetectorUnderTest& detector);

}  // namespace assay::properties
