#include "detector/boundary/boundary_handler.h"

#include <algorithm>

#include "detector/boundary/apex_choice.h"

namespace assay::detector {

Surface BoundaryHandler::close_up(const TrianglesView& triangles, Eigen::Index vertex_count,
                                  PacedStop& pace) const {
  return make_surface(triangles, vertex_count, pace);
}

std::vector<ApexRule> BoundaryHandler::choose_apexes(const Surface& surface,
                                                     BoundingVolumeTree& tree,
                                                     const PositionsView& x,
                                                     const ElementaryTest& elementary,
                                                     const StopFunction& stop) const {
  if (surface.is_closed()) return {};
  PacedStop pace(stop);
  if (!tree.refit(surface.mesh, {x, x}, pace)) return std::vector<ApexRule>(surface.loops.size());
  return ApexChoice(surface, tree, x, elementary, stop).run().rules;
}

std::vector<MovingPoint> BoundaryHandler::place_apexes(const Surface& surface,
                                                       const std::vector<ApexRule>& rules,
                                                       const SteppedMesh& motion) const {
  std::vector<MovingPoint> apexes;
  for (std::size_t l = 0; l < surface.loops.size(); ++l) {
    apexes.push_back({place_apex(rules[l], surface.loops[l], motion.vertices_t0),
                      place_apex(rules[l], surface.loops[l], motion.vertices_t1)});
  }
  return apexes;
}

// With a tree for each hole this takes as long as ghost by ghost or up to 2 % less (124 ghosts
// against 25,472 triangles: 0.49 ms and 0.50 ms), because the same elementary tests take nearly
// all the time.
bool BoundaryHandler::sweep(const GhostSweep& sweep, std::span<const std::int32_t> ghosts,
                            const StopFunction& stop, std::vector<std::uint8_t>& touched,
                            GhostCounts& counts) const {
  GhostSweep as_asked = sweep;
  if (test_ == GhostTest::boxes) as_asked.test = test_;
  const auto holes = make_hole_trees(sweep.surface.all(), ghosts, sweep.tree.grid(), sweep.motion);
  return std::all_of(holes.begin(), holes.end(), [&](const HoleTree& hole) {
    return sweep_hole(as_asked, hole, stop, touched, counts);
  });
}

}  // namespace assay::detector
