// The smallest and the largest view value of a step, in doubles. They tell how close it came.
#pragma once

#include <span>

#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "properties/laws/facts/value_range.h"

namespace assay::properties {

// The values are |(x - n(x)).N| at the vertices of the triangles, at 17 times of the step. A sign
// change of a triangle counts as 0. They are in units of the step's own, so that nothing
// overflows.
//
// Looks at the triangles given (indices into `surface`), all seen from one primitive. The rows of
// x are the vertices of the surface. About 0.5 us a triangle.
ValueRange view_range(const detector::Topology& surface, std::span<const std::int32_t> triangles,
                      const detector::SteppedMesh& motion,
                      const detector::ViewPrimitive& primitive);

}  // namespace assay::properties
