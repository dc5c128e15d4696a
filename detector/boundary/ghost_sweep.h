// Which triangles of the mesh the ghosts touch (L11).
#pragma once

#include "detector/boundary/face_pair_test.h"
#include "detector/search/pair_search.h"

namespace assay::detector {

struct GhostSweep {
  const Surface& surface;
  const BoundingVolumeTree& tree;  // of the mesh, refitted to the step
  PositionsView x_t0, x_t1;        // rows: vertices of the mesh, then apexes
  const ElementaryTest& elementary;
  bool piercing_at_start = false;  // also edges that pierce at t=0: where no state is known
};

// Sets touched[t] of each mesh triangle t that `ghost` (an index into surface.all()), of the same
// component, touches at any time in [0,1]: closed faces of the two that share no vertex meet, those
// of triangles next to the loop and of degenerate ghosts included. Triangles that are set already
// are not looked at again. Costs a descent of the tree and up to 15 elementary tests a pair.
void sweep_ghost(const GhostSweep& sweep, std::int32_t ghost, std::vector<std::uint8_t>& touched,
                 GhostCounts& counts);

}  // namespace assay::detector
