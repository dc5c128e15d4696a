// Whether an unsafe answer is one by another method than the oracle, which called it so.
#pragma once

#include "corpus/cases/case_file.h"
#include "detector/step_result.h"
#include "properties/judging/agreement.h"

namespace assay::reports {

// A contact of step s that was missed, or met too late, or one of the pairs that are missing,
// shown by the referee (a proof without roots) where any time of the step will do, or by rational
// arithmetic at a witness: a time before the one told at which the two features meet, or, where
// the contract asks for all features, their two triangles. REQUIRES an unsafe diff of that step.
bool is_confirmed(const corpus::Case& c, std::size_t s, const properties::StepDiff& diff,
                  const detector::StepResult& result, const properties::Contract& contract);

}  // namespace assay::reports
