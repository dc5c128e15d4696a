// The closed-up surface S = M + G: the mesh and the ghost triangles that close it. A detector has
// the surface of its mesh:
//
//   const Surface& surface = detector.surface();
//   for (const Loop& loop : surface.loops) use(loop.size());
//   if (!surface.is_closed()) use(surface.ghost_count());
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/topology.h"

namespace assay::detector {

// The unmatched edges of a mesh form closed walks, its boundary loops. A mesh without unmatched
// edges is a cycle and has no loops.
//
// A loop is the list of its vertices in order; its last edge leads from the last vertex to the
// first. A vertex can occur more than once.
using Loop = std::vector<std::int32_t>;

// Returns closed walks into which the unmatched edges are split; none for a cycle. If the triangles
// use the directed edge (u,v) k times more often than (v,u), it is unmatched k times. Whatever the
// triangles are, as many unmatched edges enter a vertex as leave it, so a split into closed walks
// exists. Any split would do (L12, detector/LAWS.md). The split made here is the same on every
// machine: a walk starts with the lowest unused unmatched edge, and from each vertex it goes along
// the lowest unused edge that leaves the vertex. It ends at a vertex that no unused edge leaves.
// O(N + M).
std::vector<Loop> boundary_loops(const Topology& mesh);
// Does the same with a pace. If `pace` was stopped the result is of no use.
std::vector<Loop> boundary_loops(const Topology& mesh, PacedStop& pace);

// A mesh with its ghosts. Ghosts take part in the view test, in winding numbers and in the ghost
// sweep. They are never in pair sets or in the tree.
struct Surface {
  Topology mesh;            // M
  std::vector<Loop> loops;  // the boundary loops of M; none for a cycle
  // S, or empty if there are no loops. First come the mesh's triangles, then for each loop in turn
  // one ghost (v, u, apex) for each of its edges (u, v). The apex of loop l is vertex first_apex +
  // l. Its components are the components of M, in the same order; in each, the ghosts come after
  // the triangles of M. A detector whose culling has no views makes the ghosts only when
  // Detector::surface is called.
  Topology with_ghosts;
  std::int32_t first_apex = 0;  // the number of the mesh's vertices

  bool is_closed() const { return loops.empty(); }
  const Topology& all() const { return is_closed() ? mesh : with_ghosts; }
  std::size_t ghost_count() const { return all().triangles.size() - mesh.triangles.size(); }
};

// REQUIRES triangles that have passed check_corners. O(N + M).
Surface make_surface(const TrianglesView& triangles, Eigen::Index vertex_count);
// Does the same with a pace. If `pace` was stopped the result is of no use.
Surface make_surface(const TrianglesView& triangles, Eigen::Index vertex_count, PacedStop& pace);
// The two parts of make_surface.
Surface surface_without_ghosts(const TrianglesView& triangles, Eigen::Index vertex_count,
                               PacedStop& pace);
void add_ghosts(Surface& surface, PacedStop& pace);

}  // namespace assay::detector
