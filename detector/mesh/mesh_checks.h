// What the detector asks of its input (L12: never `free` on a guess; doubtful input is a named
// error or is answered without trust, never silently repaired).
#pragma once

#include <optional>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/problem.h"
#include "detector/mesh/types.h"

namespace assay::detector {

// Indices have 31 bits. Each triangle may have three unmatched edges, and so three ghosts: four
// triangles, whose 12 corners stand in one list, and whose directed edges are 12 numbers at most (6
// for the triangle's own edges, 2 for each ghost's next edge to the apex).
inline constexpr Eigen::Index most_triangles = ((std::int64_t{1} << 31) - 1) / 12;
// Apexes are numbered after the vertices, and there are no more than triangles.
inline constexpr Eigen::Index most_vertices = (std::int64_t{1} << 31) - 1 - most_triangles;

// no_triangles, mesh_too_large, index_out_of_range, repeated_index or same_vertices_twice; the
// first in that order, at the lowest triangle. Or stopped. O(N + M).
std::optional<Problem> check_triangles(const TrianglesView& triangles, Eigen::Index vertex_count);
std::optional<Problem> check_triangles(const TrianglesView& triangles, Eigen::Index vertex_count,
                                       PacedStop& pace);

// wrong_frame_size or non_finite_coordinate. O(N).
std::optional<Problem> check_positions(const PositionsView& positions, Eigen::Index vertex_count);

}  // namespace assay::detector
