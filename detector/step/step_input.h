// What a step is asked with: checks, and the answer to what fails them.
#pragma once

#include <span>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/problem.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/surface.h"
#include "detector/options.h"
#include "detector/step_result.h"

namespace assay::detector {

// wrong_frame_size, non_finite_coordinate, wrong_primitive_count (neither none, nor one, nor one
// for each component). What `pace` has workers for is shared out to them; it is not asked to stop.
std::optional<Problem> check_step_input(const Surface& surface, const PositionsView& x_t0,
                                        const PositionsView& x_t1,
                                        std::span<const ViewPrimitive> primitives, PacedStop& pace);

// Answer::error with its reason.
StepResult refused(Problem problem);

}  // namespace assay::detector
