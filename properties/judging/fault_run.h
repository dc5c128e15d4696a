// A planted fault on a case of the corpus, judged by the oracle.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/step_result.h"
#include "properties/faults/fault.h"
#include "properties/judging/agreement.h"
#include "properties/judging/judged_run.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// The case's script through a detector of these stages, one result a step. The case's own view
// primitive is used where the culling is one of views. A mesh that is refused gives the answer
// `error` in every step.
std::vector<detector::StepResult> run_case(const corpus::Case& c, const detector::Options& options,
                                           const detector::Stages& stages);
std::vector<detector::StepResult> run_case(const corpus::Case& c, const Fault& fault);

// The same run disturbed: each step is first evaluated and stopped, at one asking after the other,
// and evaluated whole behind each stop; then taken while a second detector of such stages works on
// the same step in between. A detector takes no notice: undecided evaluations change nothing, and
// two detectors share nothing. Of a step one result is given, one that differs from `undisturbed`
// where there is one.
using MakeStages = detector::Stages (*)(const detector::Options&);
std::vector<detector::StepResult> run_disturbed(const corpus::Case& c,
                                                const detector::Options& options, MakeStages stages,
                                                std::span<const detector::StepResult> undisturbed);
// To compare the two: without the counts of marking, which rest on the marking before, be its step
// committed or not.
CaseRun without_marking_counts(std::vector<detector::StepResult> results);

// A step at which a detector does not keep what its options claim.
struct StepDefect {
  std::size_t step = 0;
  StepDiff diff;
};

// The first one; judgements: of judge_case. Of a fault that shows in a disturbed run, also the
// first step at which that run differs.
std::optional<StepDefect> first_defect(std::span<const detector::StepResult> results,
                                       std::span<const oracle::StepJudgement> judgements,
                                       detector::Pairs claimed);
std::optional<StepDefect> first_defect(const corpus::Case& c, const Fault& fault,
                                       std::span<const oracle::StepJudgement> judgements);

// The detector itself, with the options of the fault: it must hold where the fault does not.
std::optional<StepDefect> first_defect_without(const corpus::Case& c, const Fault& fault,
                                               std::span<const oracle::StepJudgement> judgements);

}  // namespace assay::properties
