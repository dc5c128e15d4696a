// Rounds a run to coordinates of few bits, so that translations and midpoints are exact.
#pragma once

#include "properties/laws/metamorphic/pinned_run.h"

namespace assay::properties {

// The run with every coordinate of vertices, primitives and apexes rounded to a multiple of one
// power of two: 2^-30 of the least power of two above them all (or the least denormal, if that is
// greater).
PinnedRun on_a_grid(PinnedRun run);

// The exponent of the least power of two above all coordinates.
int exponent_above(const PinnedRun& run);

// Applies `move` to every vertex, primitive and apex of every frame.
void move_points(PinnedRun& run, const std::function<detector::Point(detector::Point)>& move);

}  // namespace assay::properties
