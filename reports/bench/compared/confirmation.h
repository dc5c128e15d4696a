// Confirms, by another method than the oracle, that an answer which the oracle called unsafe is
// so.
#pragma once

#include "corpus/cases/case_file.h"
#include "detector/step_result.h"
#include "properties/judging/agreement.h"

namespace assay::reports {

// Whether another method shows that step s has a contact that was missed or met too late, or one
// of the pairs that are missing. If any time of the step will do, this is the referee (a proof
// without roots). Otherwise it is rational arithmetic at a witness: a time before the one that the
// detector told at which the two features meet or, if the contract asks for all features, their
// two triangles; or two times between which the features are proved to meet
// (oracle/referee/rational_bracket.h). REQUIRES an unsafe diff of that step.
bool is_confirmed(const corpus::Case& c, std::size_t s, const properties::StepDiff& diff,
                  const detector::StepResult& result, const properties::Contract& contract);

}  // namespace assay::reports
