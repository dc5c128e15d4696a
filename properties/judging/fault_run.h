// Runs planted faults on cases.
#pragma once

#include <span>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/step_result.h"
#include "properties/faults/fault.h"
#include "properties/judging/agreement.h"
#include "properties/judging/judged_run.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

// Runs the case's script through a detector of these stages, and returns one result for each step.
// The case's own view primitive is used if the culling uses views. If the mesh is refused, every
// step has the answer `error`.
std::vector<detector::StepResult> run_case(const corpus::Case& c, const detector::Options& options,
                                           const detector::Stages& stages);
std::vector<detector::StepResult> run_case(const corpus::Case& c, const Fault& fault);

// Runs the case in the same way, but disturbed. Each step is first evaluated with a stop: at the
// first time that the detector asks, then at the second and so on; after each stopped evaluation
// it is evaluated whole. Then it is taken while a second detector of the same stages works on the
// same step in between. A right detector gives the same results as undisturbed, because undecided
// evaluations change nothing and two detectors share nothing. One result is returned for each
// step: one that differs from `undisturbed`, if there is one.
using MakeStages = detector::Stages (*)(const detector::Options&);
std::vector<detector::StepResult> run_disturbed(const corpus::Case& c,
                                                const detector::Options& options, MakeStages stages,
                                                std::span<const detector::StepResult> undisturbed);
// The results as a run that can be compared with another: without the counts of marking, because
// these depend on the marking before, whether its step was committed or not.
CaseRun without_marking_counts(std::vector<detector::StepResult> results);

}  // namespace assay::properties
