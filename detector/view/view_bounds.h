// Error bounds of the view test in lanes: one for all triangles of a component, from the box around
// its vertices.
#pragma once

#include <span>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_types.h"
#include "detector/view/view_lanes.h"

namespace assay::detector {

// Units of 2^-53 times the scales named in view_bounds.cpp.
inline constexpr double lane_cubic_units = 64, lane_value_units = 112;

// Everything of the input but `corners`, for triangles between `vertices`. False where the
// coordinates are out of the range in which the bounds hold. Reads each vertex once, by the workers
// of `pace` where it has some.
bool make_lane_input(std::span<const std::int32_t> vertices, const PositionsView& x_t0,
                     const PositionsView& x_t1, const ViewPrimitive& primitive, LaneInput& input,
                     PacedStop* pace = nullptr);

}  // namespace assay::detector
