// The conditions that the detector's input has to meet. By L12 the answer is never `free` on a
// guess: doubtful input is refused with a named error, or answered in a way that does not rely on
// it. Input is never repaired silently. A program can check its input before it makes a detector:
//
//   if (auto problem = check_triangles(triangles, positions.rows())) report(problem->message);
//   if (auto problem = check_positions(x_t1, positions.rows())) report(problem->message);
#pragma once

#include <optional>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/problem.h"
#include "detector/mesh/types.h"

namespace assay::detector {

// The largest allowed number of triangles. Indices have 31 bits, and a triangle with its ghosts can
// need 12 indices. It can have three unmatched edges, and so three ghosts. These four triangles
// have 12 corners, which are numbered in one list. Their directed edges take at most 12 numbers: 6
// for the three edges of the triangle, and 2 for each ghost, because each ghost adds one edge to
// the apex; its other edge to the apex is also an edge of the next ghost.
inline constexpr Eigen::Index most_triangles = ((std::int64_t{1} << 31) - 1) / 12;
// The largest allowed number of vertices. Apexes are numbered after the vertices, and there are no
// more apexes than triangles.
inline constexpr Eigen::Index most_vertices = (std::int64_t{1} << 31) - 1 - most_triangles;

// Returns nullopt if all is well, otherwise the first error that applies, in the order
// no_triangles, mesh_too_large, index_out_of_range, repeated_index, same_vertices_twice. Its
// message names the lowest triangle that has this error. O(N + M).
std::optional<Problem> check_triangles(const TrianglesView& triangles, Eigen::Index vertex_count);
// The two parts of check_triangles. check_corners finds every error except same_vertices_twice.
// check_repeated finds same_vertices_twice; it compares triangles and so takes ten times as long as
// check_corners. It REQUIRES triangles that have passed check_corners. check_repeated returns the
// error `stopped` if the pace was stopped.
std::optional<Problem> check_corners(const TrianglesView& triangles, Eigen::Index vertex_count);
std::optional<Problem> check_repeated(const TrianglesView& triangles, Eigen::Index vertex_count,
                                      PacedStop& pace);

// Returns nullopt if all is well, otherwise wrong_frame_size or non_finite_coordinate. O(N).
std::optional<Problem> check_positions(const PositionsView& positions, Eigen::Index vertex_count);

// Returns nullopt if all is well, otherwise the first of these errors that applies:
//   wrong_frame_size: `body` or `rest` does not have one element for each vertex;
//   index_out_of_range, in a list or a pair of bodies; triangle_of_two_bodies;
//   non_finite_coordinate, in `rest`;
//   wrong_relation: rings below 0, a distance that is negative or not finite, a triangle paired
//   with itself, an edge that no triangle has, or a list that belongs to the other level.
// REQUIRES triangles that have passed check_triangles. O(N + M), or O(M log M) if pairs of edges
// are listed.
std::optional<Problem> check_counted_pairs(const CountedPairs& counted,
                                           const TrianglesView& triangles,
                                           Eigen::Index vertex_count);

}  // namespace assay::detector
