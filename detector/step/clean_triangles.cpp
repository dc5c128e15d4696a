#include "detector/step/clean_triangles.h"

#include <algorithm>

namespace assay::detector {
namespace {

constexpr std::uint64_t work_of_asking = 200;  // in box tests: of the least component

bool is_known(const StepWork& work, std::size_t c) { return work.known && !work.known->lost[c]; }

}  // namespace

bool is_all_known(const StepWork& work) {
  return work.known &&
         std::find(work.known->lost.begin(), work.known->lost.end(), 1) == work.known->lost.end();
}

void take_clean_at_start(StepWork& work, Start start) {
  work.lost.assign(work.surface.mesh.components.size(), 0);
  for (std::size_t c = 0; c < work.lost.size(); ++c) {
    const bool vouched = start == Start::clean && !work.known;
    work.lost[c] = !vouched && !is_known(work, c);
    for (const auto t : work.own_triangles(c)) {
      work.clean[at(t)] = vouched ? 1 : work.lost[c] ? 0 : work.known->clean[at(t)];
    }
  }
}

bool find_clean_at_start(StepWork& work, const ReleaseRule& release, Start start) {
  if (work.all_free()) {
    std::fill(work.clean.begin(), work.clean.end(), 1);
    return true;
  }
  std::vector<std::int32_t> to_release, to_verify;
  for (std::size_t c = 0; c < work.free.size(); ++c) {
    bool all_clean = work.free[c] != 0;
    if (!all_clean && is_known(work, c)) {
      all_clean = true;
      for (const auto t : work.own_triangles(c)) {
        work.clean[at(t)] = work.known->clean[at(t)];
        all_clean &= work.clean[at(t)] != 0;
      }
      if (!all_clean) to_release.push_back(static_cast<std::int32_t>(c));
    } else if (!all_clean && start == Start::clean && !work.known) {
      all_clean = true;
    } else if (!all_clean && start != Start::unknown) {
      all_clean = release.released_at_start(work, c);
      if (work.pace.after(work_of_asking)) return false;
      if (!all_clean) to_verify.push_back(static_cast<std::int32_t>(c));
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
  state.keep(mesh_x_t1);
  state.inside.resize(work.surface.mesh.components.size());
  for (std::size_t c = 0; c < state.inside.size(); ++c) {
    if (work.free[c]) state.inside[c] = {work.primitives[c].q0.t1, work.primitives[c].q1.t1};
  }
  release.settle(work, pairs, complete, state);
  state.lost = work.lost;
  state.lost.resize(state.inside.size(), 0);
  if (work.has_views()) return state;
  for (std::size_t c = 0; c < state.lost.size(); ++c) {
    if (!release.is_lost(work, pairs, c)) continue;
    state.lost[c] = 1;
    for (const auto t : work.own_triangles(c)) state.clean[at(t)] = 0;
  }
  return state;
}

}  // namespace assay::detector
