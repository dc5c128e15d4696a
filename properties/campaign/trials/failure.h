// A defect of a trial: which claim it breaks, how, and where.
#pragma once

#include <optional>
#include <string>

#include "corpus/cases/case_file.h"
#include "properties/judging/agreement.h"

namespace assay::properties {

// A defect, as far as it tells one defect from another.
struct Failure {
  Claim claim = Claim::total;
  // "answered free", "late", "early", "missing pair", "late pair", "answered collision", "spurious
  // pair", "early pair", "missing candidate", "error", "two runs differ", "crashed", "refused": it
  // fits the claim.
  std::string kind;
  std::size_t step = 0;                        // of the script
  std::optional<detector::TrianglePair> pair;  // the first that is wrong
  std::string configuration;
  std::string stage;    // of the built-in detector, that lost it
  std::string feature;  // of the pair
  std::string cause;    // of a plug-in, whose stages nobody knows (cause.h)
  std::string what;     // one line for people: by how much, and both answers with their times

  // Claim, kind, stage, feature, cause: what a shrunk case must keep.
  std::string signature() const;
};

// What a step shows of the first claim that it breaks, without configuration, stage and cause.
// REQUIRES a diff of this result that breaks one.
Failure failure_of(const StepDiff& diff, const detector::StepResult& result);

}  // namespace assay::properties
