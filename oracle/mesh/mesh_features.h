// Vertices, edges and triangles of a mesh as features, with the triangles that hold them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

using Edge = std::array<std::int32_t, 2>;  // vertices, lower first
using Face = std::array<std::int32_t, 3>;  // vertices, in the order of the mesh

// For each item (a vertex or an edge) the triangles that hold it, ascending. All lists lie in one
// array: that of item i begins at first[i].
struct Incidence {
  std::vector<std::size_t> first;  // by item; one more at the end: the end of the last list
  std::vector<std::int32_t> triangle;
  std::span<const std::int32_t> of(std::size_t item) const {
    return {triangle.data() + first[item], triangle.data() + first[item + 1]};
  }
};

struct MeshFeatures {
  std::vector<std::int32_t> vertices;  // those that some triangle uses, ascending
  std::vector<Edge> edges;             // unique, ascending
  std::vector<Face> faces;             // all triangles
  Incidence triangles_of_vertex;       // by place in `vertices`
  Incidence triangles_of_edge;         // by place in `edges`
};

// A triangle that repeats an index has only its edges between different vertices. n log n.
MeshFeatures mesh_features(const detector::TrianglesView& triangles);

// All pairs of triangles with the same three vertices.
std::vector<detector::TrianglePair> same_vertices_pairs(const std::vector<Face>& faces);

inline bool holds(const Face& face, std::int32_t vertex) {
  return face[0] == vertex || face[1] == vertex || face[2] == vertex;
}

inline bool share_vertex(const Edge& a, const Edge& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

}  // namespace assay::oracle
