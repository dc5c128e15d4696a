// Holes of the mesh as a stage of the detector: ghosts, their apexes, what they touch.
#pragma once

#include "detector/boundary/apex.h"
#include "detector/boundary/ghost_sweep.h"

namespace assay::detector {

class BoundaryHandler {
 public:
  explicit BoundaryHandler(GhostTest test = GhostTest::exact) : test_(test) {}
  virtual ~BoundaryHandler() = default;

  // Of no use where `pace` was stopped.
  virtual Surface close_up(const TrianglesView& triangles, Eigen::Index vertex_count,
                           PacedStop& pace) const;

  // The rule of each loop, for the life of a detector: one whose ghosts touch few triangles at x
  // (apex_choice.h). Of no use where `stop` asked for an end.
  virtual std::vector<ApexRule> choose_apexes(const Surface& surface, BoundingVolumeTree& tree,
                                              const PositionsView& x,
                                              const ElementaryTest& elementary,
                                              const StopFunction& stop = {}) const;

  // The apexes' places over a step, one a loop: at each end a function of that frame alone, so an
  // apex is where the last step left it.
  virtual std::vector<MovingPoint> place_apexes(const Surface& surface,
                                                const std::vector<ApexRule>& rules,
                                                const PositionsView& x_t0,
                                                const PositionsView& x_t1) const;

  // Sets touched[t] for the ghosts given (L11), hole by hole, a small tree each. Returns false when
  // `stop` ended it.
  virtual bool sweep(const GhostSweep& sweep, std::span<const std::int32_t> ghosts,
                     const StopFunction& stop, std::vector<std::uint8_t>& touched,
                     GhostCounts& counts) const;

 private:
  GhostTest test_;
};

}  // namespace assay::detector
