#include "detector/step/static_touches.h"

#include <algorithm>
#include <atomic>

#include "detector/boundary/hole_tree.h"
#include "detector/parallel/for_all.h"

namespace assay::detector {
namespace {

constexpr std::size_t tests_between_stops = 256;
// In box tests, the work to make a triangle's box and compare it with the roots of the holes'
// trees.
constexpr std::uint64_t work_to_look = 40;
// One, because a triangle may lie in the boxes of all ghosts of a large hole.
constexpr std::size_t triangles_of_piece = 1;

}  // namespace

bool add_lasting_contacts(const GivenStep& step, StepCost& cost,
                          std::vector<std::uint8_t>& touched) {
  const auto& triangles = step.surface.mesh.triangles;
  const FacePairTest faces(step.motion.at_start(), step.elementary, true);
  GhostCounts counts;
  std::size_t tests = 0;
  for (const auto& [a, b] : step.known->met) {
    if (touched[at(a)] && touched[at(b)]) continue;
    if (tests++ % tests_between_stops == 0 && step.stop && step.stop()) return false;
    if (faces.meet(triangles[at(a)], triangles[at(b)], counts)) touched[at(a)] = touched[at(b)] = 1;
  }
  cost.counts.release.pairs += tests;
  cost.counts.release.elementary_tests += counts.elementary_tests;
  return true;
}

bool add_ghost_touches(const GivenStep& step, StepCost& cost, const FloatGrid& grid, std::size_t c,
                       std::span<const std::int32_t> in_doubt, std::vector<std::uint8_t>& touched) {
  const Topology& all = step.surface.all();
  if (step.ghosts(c).empty()) return true;
  const SteppedMesh still = step.motion.at_start();
  const auto holes = make_hole_trees(all, step.ghosts(c), grid, still);
  const FacePairTest faces(still, step.elementary, true);
  const auto touches = [&](std::int32_t t, GhostCounts& counts) {
    const auto& corners = all.triangles[at(t)];
    const auto corner = [&](std::size_t i) { return grid(still, corners[i]); };
    const MovingBox box = box_of(corner(0), corner(1), corner(2));
    const auto meets = [&](std::int32_t ghost) {
      ++counts.pairs;
      return faces.meet(all.triangles[at(ghost)], corners, counts);
    };
    return std::any_of(holes.begin(), holes.end(),
                       [&](const HoleTree& hole) { return hole.any_near(box, meets); });
  };
  // The workers share the triangles out. Each triangle is marked and counted for itself alone.
  std::atomic<std::uint64_t> pairs = 0, elementary_tests = 0;
  const auto look_at = [&](std::size_t i, std::size_t, std::size_t) {
    const auto t = in_doubt[i];
    GhostCounts counts;
    if (!touched[at(t)] && touches(t, counts)) touched[at(t)] = 1;
    if (counts.pairs > 0) {
      pairs += counts.pairs;
      elementary_tests += counts.elementary_tests;
    }
    return work_to_look + counts.work();
  };
  const bool completed = for_all_counted(in_doubt.size(), triangles_of_piece, &cost.pace, look_at);
  cost.counts.release.pairs += pairs;
  cost.counts.release.elementary_tests += elementary_tests;
  return completed;
}

}  // namespace assay::detector
