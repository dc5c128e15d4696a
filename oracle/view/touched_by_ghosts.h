// Finds which triangles of a mesh its moving ghosts touch (L11, detector/LAWS.md).
#pragma once

#include <vector>

#include "detector/mesh/types.h"

namespace assay::oracle {

// Returns, by triangle of the mesh, 1 if some ghost touches it at any time in [0,1], else 0: closed
// faces of the two that share no vertex meet (vertex against triangle both ways, edge against
// edge). So a triangle next to the loop is tested through the features that it does not share with
// the ghost. All faces of a ghost count, its loop edge and corners too; a degenerate ghost is the
// segment or point that it has become.
//
// In the numbering of the ghosts the vertices of the mesh come first: apex k is motion.size() + k.
// It moves linearly from apexes_t0.row(k) at t=0 to apexes_t1.row(k) at t=1. REQUIRES indices in
// range, finite positions. Features that do not move are judged by integers. Each other pair of
// features whose swept boxes meet costs what contact.h says, until the triangle is known to be
// touched. If `static_at_start`, edges that pierce a face at t=0 count too, which is needed at the
// first step and after a reset.
std::vector<std::uint8_t> touched_by_ghosts(const detector::SteppedMesh& motion,
                                            const detector::TrianglesView& triangles,
                                            const detector::PositionsView& apexes_t0,
                                            const detector::PositionsView& apexes_t1,
                                            const detector::TrianglesView& ghosts,
                                            bool static_at_start = false);

// Returns the rows of the mesh, followed by those of the apexes: the numbering that ghosts use.
detector::Positions with_apexes(const detector::PositionsView& x,
                                const detector::PositionsView& apexes);

}  // namespace assay::oracle
