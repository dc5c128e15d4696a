// Vertices, edges and triangles of a mesh as features, with the triangles that hold them; its
// unmatched edges, and the ghosts that close it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"

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

// Finds the features. A triangle that repeats an index has only its edges between different
// vertices. n log n.
MeshFeatures mesh_features(const detector::TrianglesView& triangles);

// Returns all pairs of triangles with the same three vertices.
std::vector<detector::TrianglePair> same_vertices_pairs(const std::vector<Face>& faces);

inline bool holds(const Face& face, std::int32_t vertex) {
  return face[0] == vertex || face[1] == vertex || face[2] == vertex;
}

inline bool share_vertex(const Edge& a, const Edge& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

// The unmatched edges of a mesh, which keep it from being a cycle, and the ghosts that close it.
//
// A directed edge (u,v) that is used k times more than (v,u) is unmatched k times. Every vertex
// has as many unmatched edges that enter it as leave it (the boundary of any set of triangles is a
// cycle), so the unmatched edges split into closed walks, whatever the triangles are.
// An edge from a vertex to itself (a repeated index) matches itself.

using DirectedEdge = std::array<std::int32_t, 2>;  // from, to
using Loop = std::vector<std::int32_t>;            // in order; the last vertex leads to the first

// Returns each unmatched edge, as often as it is unmatched; ascending. n log n.
std::vector<DirectedEdge> unmatched_edges(const detector::TrianglesView& triangles);

// Splits the unmatched edges into closed walks that use each once. A walk starts with the lowest
// unused edge and goes on with the lowest unused edge that leaves its end. It goes on through
// repeated vertices, and through its own start as long as an unused edge leaves the start. Empty
// for a cycle. n log n.
std::vector<Loop> boundary_loops(const detector::TrianglesView& triangles);

// Returns one ghost for each edge (u,v) of each loop: (v, u, first_apex + number of the loop).
// Together with the triangles whose loops these are, the ghosts make a cycle.
detector::Triangles ghost_triangles(const std::vector<Loop>& loops, std::int32_t first_apex);

// Returns true when the given fans close the mesh with one ghost for each unmatched edge: triangles
// and ghosts together are a cycle, and each ghost holds one unmatched edge of the triangles,
// reversed, and one apex that no triangle holds. Any split of the edges into fans is valid, so the
// walks that the fans follow are not checked.
bool closes(const detector::TrianglesView& triangles, const detector::TrianglesView& ghosts);

}  // namespace assay::oracle
