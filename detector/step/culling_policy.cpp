#include "detector/step/culling_policy.h"

#include <algorithm>

namespace assay::detector {
namespace {

// What L5 takes for the smallest component, in box tests.
constexpr std::uint64_t work_of_asking = 200;

}  // namespace

void take_clean_at_start(const GivenStep& step, StepMarks& marks, Start start) {
  if (step.known) {
    marks.clean = step.known->clean;
  } else {
    std::fill(marks.clean.begin(), marks.clean.end(), start == Start::clean ? 1 : 0);
  }
}

bool find_clean_at_start(const GivenStep& step, StepMarks& marks, StepCost& cost,
                         const ReleaseRule& release, Start start, StartBy by) {
  if (marks.all_free()) {
    std::fill(marks.clean.begin(), marks.clean.end(), 1);
    return true;
  }
  std::vector<std::int32_t> to_release, to_verify;
  for (std::size_t c = 0; c < marks.free.size(); ++c) {
    bool all_clean = marks.free[c] != 0;
    if (!all_clean && step.known) {
      all_clean = true;
      for (const auto t : step.own_triangles(c)) {
        marks.clean[at(t)] = step.known->clean[at(t)];
        all_clean &= marks.clean[at(t)] != 0;
      }
      if (!all_clean) to_release.push_back(static_cast<std::int32_t>(c));
    } else if (!all_clean && start == Start::clean) {
      all_clean = true;
    } else if (!all_clean && start != Start::unknown) {
      all_clean = release.released_at_start(step, marks, cost, c);
      if (cost.pace.after(work_of_asking)) return false;
      if (!all_clean && by == StartBy::view_and_layers)
        to_verify.push_back(static_cast<std::int32_t>(c));
    }
    if (all_clean) {
      for (const auto t : step.own_triangles(c)) marks.clean[at(t)] = 1;
    }
  }
  return (to_release.empty() || release.release(step, marks, cost, to_release)) &&
         (to_verify.empty() || release.verify_start(step, marks, cost, to_verify));
}

StepState state_at_end(const GivenStep& step, const StepMarks& marks, const PacedStop& pace,
                       const ReleaseRule& release, const std::vector<PairContact>& pairs,
                       bool complete, const PositionsView& mesh_x_t1) {
  StepState state;
  state.keep(mesh_x_t1, pace);
  state.inside.resize(step.surface.mesh.components.size());
  for (std::size_t c = 0; c < state.inside.size(); ++c) {
    if (marks.free[c] && step.looks_within(c))
      state.inside[c] = {marks.primitives[c].q0.t1, marks.primitives[c].q1.t1};
  }
  release.settle(step, marks, pairs, complete, state);
  if (marks.has_views()) return state;
  for (std::size_t c = 0; c < state.inside.size(); ++c) {
    if (release.knows_clean(step, pairs, c)) continue;
    for (const auto t : step.own_triangles(c)) state.clean[at(t)] = 0;
  }
  return state;
}

}  // namespace assay::detector
