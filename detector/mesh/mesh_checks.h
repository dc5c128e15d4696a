// What the detector asks of its input (L12: never `free` on a guess; doubtful input is a named
// error or is answered without trust, never silently repaired).
#pragma once

#include <optional>

#include "detector/mesh/problem.h"
#include "detector/mesh/types.h"

namespace assay::detector {

// no_triangles, index_out_of_range, repeated_index or same_vertices_twice; the first in that order,
// at the lowest triangle. O(M log M).
std::optional<Problem> check_triangles(const TrianglesView& triangles, Eigen::Index vertex_count);

// wrong_frame_size or non_finite_coordinate. O(N).
std::optional<Problem> check_positions(const PositionsView& positions, Eigen::Index vertex_count);

}  // namespace assay::detector
