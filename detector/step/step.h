// One step through the stages of the detector.
#pragma once

#include <optional>
#include <vector>

#include "detector/parallel/workers.h"
#include "detector/step/stages.h"
#include "detector/step_result.h"
#include "detector/view/view_anchor.h"

namespace assay::detector {

struct StepContext;

// The data that only steps with views need: where each component is seen from, and the rules that
// place apexes. They are made when views are first due and not when the detector is created,
// because they take longer than all other work of creation.
//
// They are made from the positions that the detector was created with, which are kept until then.
// So results do not depend on when they are made: an evaluation leaves the state as it was.
class FirstViews {
 public:
  // For a culling without views: there is nothing to make.
  FirstViews() = default;
  explicit FirstViews(const PositionsView& x) : x_(x) {}

  enum class Making : std::uint8_t { yes, too_dear, stopped };
  // Makes the anchors and rules, unless they are made. It leaves the boxes of the tree fitted to
  // other positions. The result is too_dear if they take more than `most` work, in box tests,
  // whether or not they were made before. If they are not made, nothing of them is kept.
  Making make(StepContext& context, PacedStop& pace, double most);
  // Replaces them by those of a saved state.
  void replace(std::vector<ViewAnchor> anchors, std::vector<ApexRule> rules, double work);
  // Returns the work that making them took, once they are made. It is counted in one thread.
  double work() const { return work_; }

  // Return the anchors by component, and the rules by loop. Empty before they are made, and with a
  // culling without views.
  const std::vector<ViewAnchor>& anchors() const { return anchors_; }
  const std::vector<ApexRule>& apex_rules() const { return apex_rules_; }

 private:
  std::optional<Positions> x_;  // nothing once anchors and rules are made
  std::vector<ViewAnchor> anchors_;
  std::vector<ApexRule> apex_rules_;
  double work_ = 0;  // a lower bound of the work to make them, until they are made
};

// The data that a detector keeps for its mesh: the results of preprocessing, and the working memory
// of steps.
struct StepContext {
  Options options;
  Stages stages;
  Surface surface;
  BoundingVolumeTree tree;                  // of the mesh
  SearchMemory search;                      // with the marks of that tree
  std::unique_ptr<MeshSearch> pair_search;  // from the stage of that name
  FirstViews views;
  std::optional<std::uint64_t> adjacent_pairs;  // once the cost model has asked (culling_policy.h)
  Workers workers;
  PairRelation relation;
};

// The question that a step answers.
struct StepQuestion {
  Pairs pairs;
  double until = 1;  // with Pairs::first: a later contact is of no interest
};

// Answers the step, going on from `state`, the state of the last commit if there is one. If the
// answer is free or collision, and the step is asked about to its end, `next` is set to the state
// at that end. REQUIRES that `next` is empty; without such an answer it stays empty.
StepResult evaluate_step(StepContext& context, const std::optional<StepState>& state,
                         const SteppedMesh& mesh, const StepQuestion& question,
                         std::span<const ViewPrimitive> primitives, const StopFunction& stop,
                         std::optional<StepState>& next);

}  // namespace assay::detector
