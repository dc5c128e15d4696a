// A planted fault on a case of the corpus, judged by the oracle.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corpus/case_file.h"
#include "properties/agreement.h"
#include "properties/faults/fault.h"
#include "properties/run_verdict.h"

namespace assay::properties {

// The case's script through a detector of these stages, one result a step. The case's own view
// primitive is used where the culling is one of views. A mesh that is refused gives the answer
// `error` in every step.
std::vector<detector::StepResult> run_case(const corpus::Case& c, const detector::Options& options,
                                           const detector::Stages& stages);
std::vector<detector::StepResult> run_case(const corpus::Case& c, const Fault& fault);

// A step at which a detector does not keep what its options claim.
struct StepDefect {
  std::size_t step = 0;
  StepDiff diff;
};

// The first one; judgements: of judge_case.
std::optional<StepDefect> first_defect(std::span<const detector::StepResult> results,
                                       std::span<const oracle::StepJudgement> judgements,
                                       detector::Pairs claimed);
std::optional<StepDefect> first_defect(const corpus::Case& c, const Fault& fault,
                                       std::span<const oracle::StepJudgement> judgements);

// The detector itself, with the options of the fault: it must hold where the fault does not.
std::optional<StepDefect> first_defect_without(const corpus::Case& c, const Fault& fault,
                                               std::span<const oracle::StepJudgement> judgements);

}  // namespace assay::properties
