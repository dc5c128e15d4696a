// Which triangles of the mesh the ghosts touch (L11).
#pragma once

#include "detector/boundary/face_pair.h"
#include "detector/boundary/hole_tree.h"
#include "detector/options.h"
#include "detector/search/pair_search.h"

namespace assay::detector {

struct GhostSweep {
  const Surface& surface;
  const BoundingVolumeTree& tree;  // of the mesh, refitted to the step
  PositionsView x_t0, x_t1;        // rows: vertices of the mesh, then apexes
  const ElementaryTest& elementary;
  bool piercing_at_start = false;  // also edges that pierce at t=0: where no state is known
  GhostTest test = GhostTest::exact;
  // Where given: set for each triangle whose moving box is not apart from that of a ghost.
  std::vector<std::uint8_t>* near = nullptr;
};

// Sets touched[t] of each mesh triangle t that a ghost of the hole (ghosts of one component)
// touches at any time in [0,1]: closed faces of the two that share no vertex meet, those of
// triangles next to the loop and of degenerate ghosts included. Triangles that are set already are
// not looked at again. The hole's tree, of this step and of the tree's grid, is descended
// against the mesh's own: box tests where they meet, and up to 15 elementary tests a pair. False
// when stopped.
bool sweep_hole(const GhostSweep& sweep, const HoleTree& hole, const StopFunction& stop,
                std::vector<std::uint8_t>& touched, GhostCounts& counts);

// The same for one ghost, an index into surface.all().
void sweep_ghost(const GhostSweep& sweep, std::int32_t ghost, std::vector<std::uint8_t>& touched,
                 GhostCounts& counts);

}  // namespace assay::detector
