#include "detector/step/clean_triangles.h"

#include <algorithm>

namespace assay::detector {
namespace {

// What L5 takes for the smallest component, in box tests.
constexpr std::uint64_t work_of_asking = 200;

}  // namespace

void take_clean_at_start(StepWork& work, Start start) {
  if (work.known) {
    work.clean = work.known->clean;
  } else {
    std::fill(work.clean.begin(), work.clean.end(), start == Start::clean ? 1 : 0);
  }
}

bool find_clean_at_start(StepWork& work, const ReleaseRule& release, Start start, StartBy by) {
  if (work.all_free()) {
    std::fill(work.clean.begin(), work.clean.end(), 1);
    return true;
  }
  std::vector<std::int32_t> to_release, to_verify;
  for (std::size_t c = 0; c < work.free.size(); ++c) {
    bool all_clean = work.free[c] != 0;
    if (!all_clean && work.known) {
      all_clean = true;
      for (const auto t : work.own_triangles(c)) {
        work.clean[at(t)] = work.known->clean[at(t)];
        all_clean &= work.clean[at(t)] != 0;
      }
      if (!all_clean) to_release.push_back(static_cast<std::int32_t>(c));
    } else if (!all_clean && start == Start::clean) {
      all_clean = true;
    } else if (!all_clean && start != Start::unknown) {
      all_clean = release.released_at_start(work, c);
      if (work.pace.after(work_of_asking)) return false;
      if (!all_clean && by == StartBy::view_and_layers)
        to_verify.push_back(static_cast<std::int32_t>(c));
    }
    if (all_clean) {
      for (const auto t : work.own_triangles(c)) work.clean[at(t)] = 1;
    }
  }
  return (to_release.empty() || release.release(work, to_release)) &&
         (to_verify.empty() || release.verify_start(work, to_verify));
}

StepState state_at_end(const StepWork& work, const ReleaseRule& release,
                       const std::vector<PairContact>& pairs, bool complete,
                       const PositionsView& mesh_x_t1) {
  StepState state;
  state.keep(mesh_x_t1, work.pace);
  state.inside.resize(work.surface.mesh.components.size());
  for (std::size_t c = 0; c < state.inside.size(); ++c) {
    if (work.free[c]) state.inside[c] = {work.primitives[c].q0.t1, work.primitives[c].q1.t1};
  }
  release.settle(work, pairs, complete, state);
  if (work.has_views()) return state;
  for (std::size_t c = 0; c < state.inside.size(); ++c) {
    if (release.knows_clean(work, pairs, c)) continue;
    for (const auto t : work.own_triangles(c)) state.clean[at(t)] = 0;
  }
  return state;
}

}  // namespace assay::detector
