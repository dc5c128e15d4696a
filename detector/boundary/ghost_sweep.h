// Which triangles of the mesh the ghosts touch (L11).
#pragma once

#include "detector/boundary/face_pair.h"
#include "detector/boundary/hole_tree.h"
#include "detector/mesh/paced_stop.h"
#include "detector/search/pair_search.h"

namespace assay::detector {

// For sweeps in which nothing moves: whether to leave out also the triangles on one side of a
// ghost's plane. These are then not `near` either. `strict` leaves out what lies strictly on one
// side. `grazing` leaves out besides what, within rounding errors, touches the plane from one side
// without lying in it; then some triangles that a ghost touches may be missed.
enum class ByPlanes : std::uint8_t { no, strict, grazing };

// What a sweep works on, and how.
struct GhostSweep {
  const Surface& surface;
  const BoundingVolumeTree& tree;  // of the mesh, refitted to the step
  SteppedMesh motion;              // rows: vertices of the mesh, then apexes
  const ElementaryTest& elementary;
  // Whether edges that pierce at t=0 count too; needed if no state is known at t=0.
  bool piercing_at_start = false;
  // If given, set to 1 for each triangle whose moving box is not apart from that of a ghost.
  std::vector<std::uint8_t>* near = nullptr;
  // If given, gets the triangles that the sweep has set as touched, each once.
  std::vector<std::int32_t>* found = nullptr;
  ByPlanes by_planes = ByPlanes::no;
  // The stop function is asked at the first pair, and then after so much work (GhostCounts::work),
  // which takes about a millisecond.
  std::uint64_t work_between_stops = PacedStop::usual_interval;
  // If given, they share the mesh out among them (BoundaryHandler::sweep).
  const Workers* workers = nullptr;
};

// Sets touched[t] of each mesh triangle t that a ghost of the hole touches at any time in [0,1].
// They touch if closed faces of the two that share no vertex meet; triangles next to the loop and
// degenerate ghosts are no exceptions. Only triangles of the hole's own component are looked at.
// Those that are set already are not tested again. REQUIRES a hole tree of this step and of the
// grid of sweep.tree.
// Descends the hole's tree against the component's part of the mesh's tree, with up to 15
// elementary tests for each pair whose boxes meet. False if stopped.
bool sweep_hole(const GhostSweep& sweep, const HoleTree& hole, const StopFunction& stop,
                std::vector<std::uint8_t>& touched, GhostCounts& counts);

// The same for the triangles below one node of the mesh's tree, which must be of the hole's
// component. Sweeps below nodes of which none is above another may run at the same time, unless
// sweep.found is given.
bool sweep_hole_below(std::int32_t node, const GhostSweep& sweep, const HoleTree& hole,
                      const StopFunction& stop, std::vector<std::uint8_t>& touched,
                      GhostCounts& counts);

}  // namespace assay::detector
