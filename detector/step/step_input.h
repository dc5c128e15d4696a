// Checks of the input of a step, and the answer to input that fails them.
#pragma once

#include <span>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/problem.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/surface.h"
#include "detector/options.h"
#include "detector/step_result.h"

namespace assay::detector {

// Errors: wrong_frame_size, non_finite_coordinate, wrong_primitive_count (neither none, nor one,
// nor one for each component). Of `pace` only the workers are used; it is not asked to stop.
std::optional<Problem> check_step_input(const Surface& surface, const SteppedMesh& motion,
                                        std::span<const ViewPrimitive> primitives, PacedStop& pace);

// The result of a step that is refused: Answer::error with this problem.
StepResult refused(Problem problem);

}  // namespace assay::detector
