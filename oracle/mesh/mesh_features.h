// Vertices, edges and triangles of a mesh as features, with the triangles that hold them; the
// unmatched edges of the mesh, and the ghosts (added triangles) that close it.
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

// Lists for each item (a vertex or an edge) the triangles that hold it, ascending. All lists lie in
// one array: the list of item i begins at triangle[first[i]].
struct Incidence {
  std::vector<std::size_t> first;  // by item; the last element is the end of the last list
  std::vector<std::int32_t> triangle;
  std::span<const std::int32_t> of(std::size_t item) const {
    return {triangle.data() + first[item], triangle.data() + first[item + 1]};
  }
};

struct MeshFeatures {
  std::vector<std::int32_t> vertices;  // the vertices that some triangle uses, ascending
  std::vector<Edge> edges;             // unique, ascending
  std::vector<Face> faces;             // all triangles
  Incidence triangles_of_vertex;       // by place in `vertices`
  Incidence triangles_of_edge;         // by place in `edges`
};

// Finds the features. A triangle that repeats an index adds only its edges between different
// vertices. Takes n log n.
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
// If the directed edge (u,v) occurs k more times than (v,u), then (u,v) is unmatched k times. As
// many unmatched edges enter a vertex as leave it (the boundary of any set of triangles is a
// cycle), so the unmatched edges split into closed walks, whatever the triangles are. An edge from
// a vertex to itself (a repeated index) matches itself.

using DirectedEdge = std::array<std::int32_t, 2>;  // from, to
using Loop = std::vector<std::int32_t>;            // in order; the last vertex leads to the first

// Returns each unmatched edge, as often as it is unmatched; ascending. n log n.
std::vector<DirectedEdge> unmatched_edges(const detector::TrianglesView& triangles);

// Splits the unmatched edges into closed walks that use each edge once. A walk starts with the
// lowest unused edge and goes on with the lowest unused edge that leaves its last vertex. It goes
// on through repeated vertices, and through its own start as long as an unused edge leaves the
// start. Returns no walk for a cycle. Takes n log n.
std::vector<Loop> boundary_loops(const detector::TrianglesView& triangles);

// Returns one ghost for each edge (u,v) of each loop: (v, u, first_apex + number of the loop). The
// ghosts, together with the triangles that have these loops, are a cycle.
detector::Triangles ghost_triangles(const std::vector<Loop>& loops, std::int32_t first_apex);

// Returns whether `ghosts` closes the mesh with one ghost for each unmatched edge: triangles and
// ghosts together are a cycle, and each ghost holds one unmatched edge of the triangles, reversed,
// and one apex that no triangle holds. The ghosts of one apex form a fan. Any split of the edges
// into fans is valid, so the function does not check which walks the fans follow.
bool closes(const detector::TrianglesView& triangles, const detector::TrianglesView& ghosts);

}  // namespace assay::oracle
