// From what the stages of a step found to its result.
#pragma once

#include <span>

#include "detector/search/triangle_type.h"
#include "detector/step/step_work.h"
#include "detector/step_result.h"

namespace assay::detector {

// The type follows from the sign, the state and the ghosts. A triangle that is dirty or touched by
// a ghost gets that type whatever its sign is, because Vv is tested against everything. Without
// views every clean triangle gets the type `violated`.
TriangleType type_of(const StepMarks& marks, std::size_t triangle);

// Sets the sizes of V+, V-, V0 and Vv and the doubts in the result. REQUIRES a step with views.
void count_sets(const StepMarks& marks, StepResult& result);

// The enclosure of the first contact time; {0, 0} without pairs.
TimeEnclosure least_time(std::span<const PairContact> pairs);

}  // namespace assay::detector
