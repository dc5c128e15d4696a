#include "detector/mesh/mesh_checks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace assay::detector {
namespace {

// Infinities and not-a-numbers have an exponent of all ones. Adding one to such an exponent, and
// to no other, carries into the place of the sign. The loop has no branch, so it is as fast as
// memory.
bool all_finite(const double* values, std::size_t count) {
  constexpr std::uint64_t exponent = 0x7ff0'0000'0000'0000, one = 0x0010'0000'0000'0000;
  std::uint64_t carries = 0;
  for (std::size_t i = 0; i < count; ++i) {
    carries |= (std::bit_cast<std::uint64_t>(values[i]) & exponent) + one;
  }
  return carries >> 63 == 0;
}

std::string at_triangle(Eigen::Index t) { return "triangle " + std::to_string(t); }

struct SortedTriangle {
  std::array<std::int32_t, 3> vertices;  // ascending
  std::int32_t triangle;
};

Problem stopped_at_checks() { return {InputError::stopped, "stopped while the mesh was checked"}; }

std::optional<Problem> find_same_vertices(const TrianglesView& triangles, std::size_t vertex_count,
                                          PacedStop& pace) {
  constexpr std::uint64_t work_to_copy = 2;
  std::vector<SortedTriangle> sorted(static_cast<std::size_t>(triangles.rows())), room;
  const auto copy = [&](std::size_t i) {
    const auto t = static_cast<Eigen::Index>(i);
    sorted[i] = {{triangles(t, 0), triangles(t, 1), triangles(t, 2)}, static_cast<std::int32_t>(t)};
    std::sort(sorted[i].vertices.begin(), sorted[i].vertices.end());
  };
  if (!for_each_paced(sorted.size(), work_to_copy, pace, copy)) return stopped_at_checks();
  for (const std::size_t k : {2, 1, 0}) {
    const auto vertex = [k](const SortedTriangle& entry) { return entry.vertices[k]; };
    if (!sort_by_key(sorted, room, vertex_count, vertex, pace)) return stopped_at_checks();
  }
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].vertices == sorted[i - 1].vertices) {
      return Problem{InputError::same_vertices_twice,
                     "triangles " + std::to_string(sorted[i - 1].triangle) + " and " +
                         std::to_string(sorted[i].triangle) + " have the same three vertices"};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Problem> check_triangles(const TrianglesView& triangles, Eigen::Index vertex_count) {
  PacedStop pace(never_stops);
  return check_triangles(triangles, vertex_count, pace);
}

std::optional<Problem> check_triangles(const TrianglesView& triangles, Eigen::Index vertex_count,
                                       PacedStop& pace) {
  if (triangles.rows() == 0) return Problem{InputError::no_triangles, "the mesh has no triangles"};
  if (triangles.rows() > most_triangles || vertex_count > most_vertices) {
    return Problem{InputError::mesh_too_large,
                   "the mesh has " + std::to_string(triangles.rows()) + " triangles and " +
                       std::to_string(vertex_count) + " vertices, indices number " +
                       std::to_string(most_triangles) + " and " + std::to_string(most_vertices)};
  }
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::int32_t v = triangles(t, corner);
      if (v < 0 || v >= vertex_count) {
        return Problem{InputError::index_out_of_range, at_triangle(t) + " names vertex " +
                                                           std::to_string(v) + " of " +
                                                           std::to_string(vertex_count)};
      }
    }
  }
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const auto a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
    if (a == b || b == c || c == a) {
      return Problem{InputError::repeated_index, at_triangle(t) + " names a vertex twice"};
    }
  }
  return find_same_vertices(triangles, static_cast<std::size_t>(vertex_count), pace);
}

std::optional<Problem> check_positions(const PositionsView& positions, Eigen::Index vertex_count) {
  if (positions.rows() != vertex_count) {
    return Problem{InputError::wrong_frame_size,
                   "positions have " + std::to_string(positions.rows()) + " rows, the mesh has " +
                       std::to_string(vertex_count) + " vertices"};
  }
  const bool packed = positions.outerStride() == 3;
  if (packed && all_finite(positions.data(), static_cast<std::size_t>(positions.size()))) {
    return std::nullopt;
  }
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(positions(v, axis))) {
        return Problem{InputError::non_finite_coordinate,
                       "vertex " + std::to_string(v) + " has a coordinate that is not finite"};
      }
    }
  }
  return std::nullopt;
}

}  // namespace assay::detector
