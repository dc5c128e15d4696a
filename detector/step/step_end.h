// What the stages of a step found, brought into a result.
#pragma once

#include <span>

#include "detector/search/triangle_type.h"
#include "detector/step/step_work.h"
#include "detector/step_result.h"

namespace assay::detector {

// Of signs, state and ghosts: doubt goes before the sign, for Vv is tested against everything.
TriangleType type_of(const StepWork& work, std::size_t triangle);

// Sizes of V+, V-, V0 and Vv, and the doubts, by type.
void count_sets(const StepWork& work, StepResult& result);

// Of the first contact; {0, 0} without pairs.
TimeEnclosure least_time(std::span<const PairContact> pairs);

}  // namespace assay::detector
