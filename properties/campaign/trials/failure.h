// A defect of a trial: which claim it breaks, how, and where.
#pragma once

#include <optional>
#include <string>

#include "corpus/cases/case_file.h"
#include "properties/judging/agreement.h"

namespace assay::properties {

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

}  // namespace assay::properties
