// Plain data that every room shares: positions, triangles, moving points. No arithmetic.
//
// Notation: a step runs over t in [0,1]. Names with `_t0` are values at t=0, names with `_t1`
// values at t=1. Every vertex moves linearly in between. All coordinates are doubles taken as exact
// numbers, in the user's units.
// A program's own arrays are read where they lie:
//
//   const std::vector<double> coordinates = {0, 0, 0, 1, 0, 0, 0, 1, 0};
//   const std::vector<std::int32_t> corners = {0, 1, 2};
//   const Eigen::Map<const Positions> positions(coordinates.data(), 3, 3);
//   const Eigen::Map<const Triangles> triangles(corners.data(), 1, 3);
//   Detector detector = Detector::create(triangles, positions, {}).value();
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

// The vertices of a mesh over one step. Both views are N x 3 and have the same number of rows: row
// v is vertex v, at t=0 in one view and at t=1 in the other. If a step has ghosts, the rows of
// their apexes follow the rows of the mesh.
//
// A SteppedMesh refers to the caller's arrays and copies nothing, so the arrays must outlive it. A
// copy of a SteppedMesh holds pointers to the same arrays. One case needs care: a view that was
// made of an expression, such as the mean of two meshes, holds the values of that expression
// itself. Copies of the view refer to these values, so the first view must outlive its copies.
struct SteppedMesh {
  PositionsView vertices_t0, vertices_t1;

  Eigen::Index size() const { return vertices_t0.rows(); }  // the number of vertices
  Point start(std::int32_t vertex) const { return point_of(vertices_t0, vertex); }
  Point end(std::int32_t vertex) const { return point_of(vertices_t1, vertex); }
  MovingPoint path(std::int32_t vertex) const { return {start(vertex), end(vertex)}; }
  // Returns whether both views are of the same array, so that nothing moves.
  bool is_at_rest() const {
    return vertices_t0.data() == vertices_t1.data() && vertices_t0.rows() == vertices_t1.rows() &&
           vertices_t0.outerStride() == vertices_t1.outerStride();
  }
  // Returns the same mesh at rest: every vertex stays where it is at t=0.
  SteppedMesh at_start() const { return {vertices_t0, vertices_t0}; }
};

// Returns the place in an array of the vertex, triangle or component with this number.
constexpr std::size_t at(std::int32_t number) { return static_cast<std::size_t>(number); }

}  // namespace assay::detector
