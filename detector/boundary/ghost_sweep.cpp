#include "detector/boundary/ghost_sweep.h"

namespace assay::detector {
namespace {

class HoleSweep {
 public:
  HoleSweep(const GhostSweep& sweep, const HoleTree& hole, const StopFunction& stop,
            std::vector<std::uint8_t>& touched, GhostCounts& counts)
      : sweep_(sweep),
        tree_(sweep.tree),
        all_(sweep.surface.all()),
        hole_(hole),
        component_(all_.component_of_triangle[at(hole.first_ghost())]),
        stop_(stop),
        touched_(touched),
        counts_(counts),
        faces_(sweep.x_t0, sweep.x_t1, sweep.elementary, sweep.piercing_at_start) {}

  bool run() {
    descend(HoleTree::root, BoundingVolumeTree::root);
    return !stopped_;
  }

 private:
  // Both are split at once, so that their boxes stay of like size.
  void descend(std::size_t of_hole, std::int32_t node) {
    const auto component = tree_.component(node);
    if (stopped_ || (component != component_ && component != mixed_components)) return;
    if (apart(hole_.box(of_hole), tree_.box(node))) return;
    const bool splits_hole = !hole_.is_leaf(of_hole), splits_tree = !tree_.is_leaf(node);
    if (!splits_hole && !splits_tree) {
      test(hole_.ghost(of_hole), tree_.triangle(node));
      return;
    }
    const auto ghosts = splits_hole ? hole_.child(of_hole) : of_hole;
    const auto nodes = splits_tree ? tree_.child(node) : node;
    for (auto g = ghosts; g <= ghosts + splits_hole; ++g) {
      for (auto n = nodes; n <= nodes + splits_tree; ++n) descend(g, n);
    }
  }

  void test(std::int32_t ghost, std::int32_t t) {
    constexpr std::uint64_t pairs_between_stops = 256;
    if (counts_.pairs++ % pairs_between_stops == 0 && stop_ && stop_()) stopped_ = true;
    if (sweep_.near) (*sweep_.near)[at(t)] = 1;
    if (stopped_ || touched_[at(t)]) return;
    touched_[at(t)] = sweep_.test == GhostTest::boxes ||
                      faces_.meet(all_.triangles[at(ghost)], all_.triangles[at(t)], counts_);
  }

  const GhostSweep& sweep_;
  const BoundingVolumeTree& tree_;
  const Topology& all_;
  const HoleTree& hole_;
  const std::int32_t component_;
  const StopFunction& stop_;
  std::vector<std::uint8_t>& touched_;
  GhostCounts& counts_;
  const FacePairTest faces_;
  bool stopped_ = false;
};

}  // namespace

bool sweep_hole(const GhostSweep& sweep, const HoleTree& hole, const StopFunction& stop,
                std::vector<std::uint8_t>& touched, GhostCounts& counts) {
  return HoleSweep(sweep, hole, stop, touched, counts).run();
}

void sweep_ghost(const GhostSweep& sweep, std::int32_t ghost, std::vector<std::uint8_t>& touched,
                 GhostCounts& counts) {
  const HoleTree alone(sweep.surface.all(), {&ghost, 1}, sweep.tree.grid(), sweep.x_t0, sweep.x_t1);
  sweep_hole(sweep, alone, {}, touched, counts);
}

}  // namespace assay::detector
