// Plain data that every room shares: positions, triangles, moving points. No arithmetic.
//
// Notation: a step runs over t in [0,1]; `_t0`, `_t1` are its two ends and every vertex moves
// linearly between them. All coordinates are doubles taken as exact numbers, in the user's units.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace assay::detector {

// N x 3, row-major: one vertex a row.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
// M x 3, row-major: one oriented triangle a row (counter-clockwise seen from outside).
using Triangles = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

// Views of a caller's arrays; contiguous row-major arrays are never copied.
using PositionsView = Eigen::Ref<const Positions>;
using TrianglesView = Eigen::Ref<const Triangles>;

using Point = std::array<double, 3>;

struct MovingPoint {
  Point t0, t1;
};

inline Point point_of(const PositionsView& x, std::int32_t vertex) {
  return {x(vertex, 0), x(vertex, 1), x(vertex, 2)};
}

inline MovingPoint moving_point(const PositionsView& x_t0, const PositionsView& x_t1,
                                std::int32_t vertex) {
  return {point_of(x_t0, vertex), point_of(x_t1, vertex)};
}

// The place in an array of the vertex, triangle or component with this number.
constexpr std::size_t at(std::int32_t number) { return static_cast<std::size_t>(number); }

}  // namespace assay::detector
