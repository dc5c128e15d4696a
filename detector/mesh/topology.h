// Adjacency of a triangle mesh: edges, incidences, components, and which components are cycles.
// This needs no detector:
//
//   const Topology mesh = make_topology(triangles, positions.rows());
//   for (const Component& component : mesh.components) use(component.is_cycle);
//   for (const std::int32_t t : mesh.vertex_triangles.row(0)) use(mesh.triangles[at(t)]);
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "detector/mesh/large_array.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/types.h"

namespace assay::detector {

// Rows of varying length in one array. Row i is items[starts[i]] to items[starts[i+1] - 1].
struct Incidence {
  LargeArray<std::int32_t> starts, items;
  std::span<const std::int32_t> row(std::int32_t i) const {
    const auto begin = static_cast<std::size_t>(starts[static_cast<std::size_t>(i)]);
    const auto end = static_cast<std::size_t>(starts[static_cast<std::size_t>(i) + 1]);
    return {items.data() + begin, end - begin};
  }
};

// A component: triangles connected through shared vertices.
struct Component {
  LargeArray<std::int32_t> triangles;  // ascending
  LargeArray<std::int32_t> vertices;   // ascending
  // True if every directed edge (u,v) occurs as often as (v,u). Other components need ghosts for L3
  // to L5. An edge of a cycle can have 4 or 6 triangles, if half of them pass it each way.
  bool is_cycle = false;
};

// An edge that its triangles pass more often in one direction than in the other. `surplus` is a -
// b, where a triangles pass the edge from its lower vertex to its higher vertex, and b triangles
// pass it the other way.
struct UnmatchedEdge {
  std::int32_t edge, surplus;
};

struct Topology {
  LargeArray<std::array<std::int32_t, 3>> triangles;
  LargeArray<std::array<std::int32_t, 2>> edges;           // (u,v), u < v, ascending
  LargeArray<std::array<std::int32_t, 3>> triangle_edges;  // edge opposite to corner i at place i
  Incidence vertex_triangles, edge_triangles;
  std::vector<UnmatchedEdge> unmatched;  // ascending by edge
  std::vector<Component> components;     // ascending by their lowest vertices
  std::vector<std::int32_t> component_of_triangle;
  // If false, no two triangles have the same three vertices. It is false only if every edge has one
  // triangle, or two that differ in their third vertex.
  bool may_repeat_triangles = false;
};

// REQUIRES triangles that have passed check_corners. O(N + M).
Topology make_topology(const TrianglesView& triangles, Eigen::Index vertex_count);
// Does the same with a pace. If `pace` was stopped the result is of no use.
Topology make_topology(const TrianglesView& triangles, Eigen::Index vertex_count, PacedStop& pace);

}  // namespace assay::detector
