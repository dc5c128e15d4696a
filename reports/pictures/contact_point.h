// Where two triangles meet, for pictures. It is computed in plain doubles, and no verdict rests on
// it.
#pragma once

#include <optional>

#include "detector/mesh/step_types.h"

namespace assay::reports {

// The place of the contact at time t in [0,1] of the step: the vertex of a vertex-face contact,
// the middle of the closest points of two edges, the point where a piercing edge crosses the
// plane, or the centre of triangles with the same vertices. If no feature is named, as by a
// plug-in: the middle of the closest points of the two triangles. Nothing if there is no such
// place, because all features share a vertex, or because it overflows.
std::optional<detector::Point> contact_point(const detector::PairContact& contact,
                                             const detector::TrianglesView& triangles,
                                             const detector::PositionsView& x_t0,
                                             const detector::PositionsView& x_t1, double t);

}  // namespace assay::reports
