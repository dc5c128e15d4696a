// One step through the stages of the detector.
#pragma once

#include "detector/parallel/workers.h"
#include "detector/step/first_views.h"
#include "detector/step_result.h"

namespace assay::detector {

// What a detector keeps of its mesh: what preprocessing made, and what steps work in.
struct StepContext {
  Options options;
  Stages stages;
  Surface surface;
  BoundingVolumeTree tree;                  // of the mesh
  SearchMemory search;                      // with the marks of that tree
  std::unique_ptr<MeshSearch> pair_search;  // from the stage of that name
  FirstViews views;
  std::optional<std::uint64_t> adjacent_pairs;  // once the cost model has asked (cost_model.h)
  Workers workers;
  PairRelation relation;
};

// False if it was stopped.
inline bool make_first_views(StepContext& context, PacedStop& pace) {
  return context.views.make(context.surface, context.tree, context.stages, context.options.culling,
                            pace);
}

// What a step is asked for.
struct StepQuestion {
  Pairs pairs;
  double until = 1;  // with Pairs::first: a later contact is of no interest
};

// Answers the step, going on from `known`, the state of the last commit if there is one. If the
// answer is free or collision, and the step is asked about to its end, `next` is set to the state
// at that end. REQUIRES that `next` is empty; otherwise it stays so.
StepResult evaluate_step(StepContext& context, const std::optional<StepState>& known,
                         const SteppedMesh& mesh, const StepQuestion& question,
                         std::span<const ViewPrimitive> primitives, const StopFunction& stop,
                         std::optional<StepState>& next);

}  // namespace assay::detector
