// The closed-up surface S = M + G: the mesh and the ghost triangles that close it.
#pragma once

#include "detector/mesh/loops.h"

namespace assay::detector {

// A mesh with its ghosts. Ghosts take part in the view test, in winding numbers and in the ghost
// sweep. They are never in pair sets or in the tree.
struct Surface {
  Topology mesh;            // M
  std::vector<Loop> loops;  // the boundary loops of M; none for a cycle
  // S, or empty if there are no loops. First come the mesh's triangles, then for each loop in turn
  // one ghost (v, u, apex) for each of its edges (u, v). The apex of loop l is vertex first_apex +
  // l. Components are those of M, in the same order; the ghosts of each stand after its own
  // triangles.
  Topology with_ghosts;
  std::int32_t first_apex = 0;  // the number of the mesh's vertices

  bool is_closed() const { return loops.empty(); }
  const Topology& all() const { return is_closed() ? mesh : with_ghosts; }
  std::size_t ghost_count() const { return all().triangles.size() - mesh.triangles.size(); }
};

// REQUIRES triangles that have passed check_triangles. O(N + M).
Surface make_surface(const TrianglesView& triangles, Eigen::Index vertex_count);
// The same with a pace. If `pace` was stopped the result is of no use.
Surface make_surface(const TrianglesView& triangles, Eigen::Index vertex_count, PacedStop& pace);

}  // namespace assay::detector
