// Which triangles of a mesh its moving ghosts touch (L11, detector/README.md).
#pragma once

#include <vector>

#include "detector/mesh/types.h"

namespace assay::oracle {

struct GhostSweepOptions {
  int jobs = 1;
  // Also edges that pierce at t=0: at the first step and after a reset.
  bool static_at_start = false;
};

// touched[t] is 1 for each triangle t of the mesh that some ghost touches at any time in [0,1]:
// closed faces of the two that share no vertex meet (vertex against triangle both ways, edge
// against edge), so triangles next to the loop are tested through the features that they do not
// share with the ghost. All faces of a ghost count, its loop edge and corners included; degenerate
// ghosts are the segments or points that they have become.
//
// Vertices of the mesh come first: ghosts name apex k as x_t0.rows() + k, at apexes_t0.row(k) at
// t=0 and apexes_t1.row(k) at t=1, linear in between. REQUIRES indices in range, finite positions.
// What is at rest, ghost and triangle, is judged by integers; otherwise cost is that of contact.h
// for each pair of features whose swept boxes meet, until the triangle is known to be touched.
std::vector<std::uint8_t> touched_by_ghosts(const detector::PositionsView& x_t0,
                                            const detector::PositionsView& x_t1,
                                            const detector::TrianglesView& triangles,
                                            const detector::PositionsView& apexes_t0,
                                            const detector::PositionsView& apexes_t1,
                                            const detector::TrianglesView& ghosts,
                                            const GhostSweepOptions& options = {});

// Rows of the mesh, then rows of the apexes: the numbering that ghosts use.
detector::Positions with_apexes(const detector::PositionsView& x,
                                const detector::PositionsView& apexes);

}  // namespace assay::oracle
