// Which triangles of the mesh the ghosts touch (L11).
#pragma once

#include "detector/boundary/face_pair.h"
#include "detector/boundary/hole_tree.h"
#include "detector/mesh/paced_stop.h"
#include "detector/options.h"
#include "detector/search/pair_search.h"

namespace assay::detector {

// Where nothing moves: whether what lies on one side of a ghost's plane is left out too, and so is
// not near. Grazing: also what may touch the plane from one side, by the size of rounding errors,
// without lying in it; then some of what a ghost touches may be missed.
enum class ByPlanes : std::uint8_t { no, strict, grazing };

struct GhostSweep {
  const Surface& surface;
  const BoundingVolumeTree& tree;  // of the mesh, refitted to the step
  PositionsView x_t0, x_t1;        // rows: vertices of the mesh, then apexes
  const ElementaryTest& elementary;
  bool piercing_at_start = false;  // also edges that pierce at t=0: where no state is known
  GhostTest test = GhostTest::exact;
  // Where given: set for each triangle whose moving box is not apart from that of a ghost.
  std::vector<std::uint8_t>* near = nullptr;
  // Where given: the triangles that the sweep has set, each once.
  std::vector<std::int32_t>* found = nullptr;
  ByPlanes by_planes = ByPlanes::no;
  // `stop` is asked at the first pair and after so much work (GhostCounts): a millisecond.
  std::uint64_t work_between_stops = PacedStop::usual_interval;
};

// Sets touched[t] of each mesh triangle t that a ghost of the hole (ghosts of one component)
// touches at any time in [0,1]: closed faces of the two that share no vertex meet, those of
// triangles next to the loop and of degenerate ghosts included. Triangles that are set already are
// not looked at again. The hole's tree, of this step and of the tree's grid, is descended against
// the component's part of the mesh's own: box tests where they meet, and up to 15 elementary tests
// a pair. False when stopped.
bool sweep_hole(const GhostSweep& sweep, const HoleTree& hole, const StopFunction& stop,
                std::vector<std::uint8_t>& touched, GhostCounts& counts);

// The same for one ghost, an index into surface.all().
void sweep_ghost(const GhostSweep& sweep, std::int32_t ghost, std::vector<std::uint8_t>& touched,
                 GhostCounts& counts);

}  // namespace assay::detector
