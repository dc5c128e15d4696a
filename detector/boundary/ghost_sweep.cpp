#include "detector/boundary/ghost_sweep.h"

namespace assay::detector {

void sweep_ghost(const GhostSweep& sweep, std::int32_t ghost, std::vector<std::uint8_t>& touched,
                 GhostCounts& counts) {
  const Topology& all = sweep.surface.all();
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  const auto& corners = all.triangles[at(ghost)];
  const FacePairTest faces(sweep.x_t0, sweep.x_t1, sweep.elementary, sweep.piercing_at_start);
  SearchCounts descent;
  const MovingBox box = sweep.tree.box_of_triangle(corners, sweep.x_t0, sweep.x_t1);
  search_box(sweep.tree, box, descent, [&](std::int32_t t) {
    if (all.component_of_triangle[at(t)] != all.component_of_triangle[at(ghost)]) return true;
    ++counts.pairs;
    if (!touched[at(t)] && faces.meet(corners, all.triangles[at(t)], counts)) touched[at(t)] = 1;
    return true;
  });
}

}  // namespace assay::detector
