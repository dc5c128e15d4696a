// Error bounds of the view test in lanes. All triangles of a component have the same bound, which
// comes from the box around the component's vertices.
#pragma once

#include <span>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_types.h"
#include "detector/view/view_lanes.h"

namespace assay::detector {

// In units of 2^-53 times the scales named in view_bounds.cpp.
inline constexpr double lane_cubic_units = 64, lane_value_units = 112;

// Fills in everything of `input` but `corners`, for triangles whose corners are among `vertices`.
// False if the coordinates are out of the range in which the bounds hold. It reads each vertex
// once, and the workers of `pace` share the work if it has some.
bool make_lane_input(std::span<const std::int32_t> vertices, const SteppedMesh& motion,
                     const ViewPrimitive& primitive, LaneInput& input, PacedStop* pace = nullptr);

}  // namespace assay::detector
