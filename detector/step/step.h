// One step through the stages of the detector.
#pragma once

#include "detector/parallel/workers.h"
#include "detector/step/stages.h"
#include "detector/step_result.h"
#include "detector/view/view_anchor.h"

namespace assay::detector {

// What preprocessing made of a mesh.
struct StepContext {
  Options options;
  Stages stages;
  Surface surface;
  BoundingVolumeTree tree;           // of the mesh
  SearchMemory search;               // the marks of that tree
  std::vector<ViewAnchor> anchors;   // one for each component
  std::vector<ApexRule> apex_rules;  // one for each loop
  std::uint64_t adjacent_pairs = 0;  // of the mesh; the cost model's (cost_model.h)
  Workers workers;
};

// Answers the step from `known`, the state of the last commit if any. `next` is set to the state
// at the end of the step when there is an answer (free or collision), else left empty.
StepResult evaluate_step(StepContext& context, const std::optional<StepState>& known,
                         const PositionsView& x_t0, const PositionsView& x_t1,
                         std::span<const ViewPrimitive> primitives, const StopFunction& stop,
                         std::optional<StepState>& next);

}  // namespace assay::detector
