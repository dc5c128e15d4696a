// Finds which triangles of a mesh its moving ghosts touch (L11, detector/LAWS.md).
#pragma once

#include <vector>

#include "detector/mesh/types.h"

namespace assay::oracle {

// Returns for each triangle of the mesh 1 if some ghost touches it at some time in [0,1], else 0. A
// ghost touches a triangle if a closed face of the ghost meets a closed face of the triangle, and
// the two faces share no vertex (vertex against triangle both ways, edge against edge). So a
// triangle next to the loop is tested through the features that it does not share with the ghost.
// All faces of a ghost count, its loop edge and corners too. A degenerate ghost is treated as the
// segment or point that it has become.
//
// `ghosts` numbers the vertices of the mesh first: apex k has the number motion.size() + k. Apex k
// moves linearly from apexes_t0.row(k) at t=0 to apexes_t1.row(k) at t=1. REQUIRES indices in
// range, finite positions. Features that do not move are judged by integers. Every other pair of
// features whose swept boxes meet costs what contact.h says; a triangle that is known to be touched
// costs nothing more. If `static_at_start`, a ghost also touches a triangle if an edge of one
// pierces the other at t=0. Set it at the first step and after a reset.
std::vector<std::uint8_t> touched_by_ghosts(const detector::SteppedMesh& motion,
                                            const detector::TrianglesView& triangles,
                                            const detector::PositionsView& apexes_t0,
                                            const detector::PositionsView& apexes_t1,
                                            const detector::TrianglesView& ghosts,
                                            bool static_at_start = false);

// Returns the rows of the mesh, followed by the rows of the apexes: the numbering that ghosts use.
detector::Positions with_apexes(const detector::PositionsView& x,
                                const detector::PositionsView& apexes);

}  // namespace assay::oracle
