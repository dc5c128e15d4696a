// The stage of the detector that handles holes: it makes ghosts, places their apexes, and finds
// what they touch.
#pragma once

#include "detector/boundary/apex.h"
#include "detector/boundary/ghost_sweep.h"

namespace assay::detector {

class BoundaryHandler {
 public:
  virtual ~BoundaryHandler() = default;

  // The mesh with its ghosts. If `pace` was stopped, it must not be used.
  virtual Surface close_up(const TrianglesView& triangles, Eigen::Index vertex_count,
                           PacedStop& pace) const;

  // The rule that places the apex of each loop for the life of a detector: one whose ghosts touch
  // few triangles at x (apex.h). If `stop` asked for an end, it must not be used.
  virtual std::vector<ApexRule> choose_apexes(const Surface& surface, BoundingVolumeTree& tree,
                                              const PositionsView& x,
                                              const ElementaryTest& elementary,
                                              const StopFunction& stop = {}) const;

  // The apex of each loop over a step. Its place at either end depends on that frame alone, so
  // each step finds it where the last one left it.
  virtual std::vector<MovingPoint> place_apexes(const Surface& surface,
                                                const std::vector<ApexRule>& rules,
                                                const SteppedMesh& motion) const;

  // Sets touched[t] of the triangles that the given ghosts touch (L11), hole by hole, with a small
  // tree for each. REQUIRES ghosts of one component. Returns false if `stop` ended it.
  virtual bool sweep(const GhostSweep& sweep, std::span<const std::int32_t> ghosts,
                     const StopFunction& stop, std::vector<std::uint8_t>& touched,
                     GhostCounts& counts) const;
};

}  // namespace assay::detector
