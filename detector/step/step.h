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

// The data that only steps with views need: the anchors from which components are seen, and the
// rules that place apexes. They are made when views are first due, not when the detector is
// created, because making them takes longer than all other work of creation.
//
// Anchors and rules are made from the positions with which the detector was created, and these
// positions are kept until then. So results do not depend on when anchors and rules are made, and
// an evaluation that makes them does not change the state.
class FirstViews {
 public:
  // For a culling without views, which has no anchors and no rules.
  FirstViews() = default;
  explicit FirstViews(const PositionsView& x) : x_(x) {}

  enum class Making : std::uint8_t { yes, too_dear, stopped };
  // Makes the anchors and rules, unless they are made already. Afterwards the boxes of the tree are
  // fitted to other positions. Returns too_dear if making them takes more than `most` work, in box
  // tests; also if they were made before with more work. If the result is too_dear or stopped, no
  // anchors and rules are added.
  Making make(StepContext& context, PacedStop& pace, double most);
  // Replaces the anchors and rules by those of a saved state.
  void replace(std::vector<ViewAnchor> anchors, std::vector<ApexRule> rules, double work);
  // Returns the work of making the anchors and rules, once they are made. It is counted in one
  // thread.
  double work() const { return work_; }

  // Return the anchors by component, and the rules by loop. Both are empty before they are made,
  // and with a culling without views.
  const std::vector<ViewAnchor>& anchors() const { return anchors_; }
  const std::vector<ApexRule>& apex_rules() const { return apex_rules_; }

 private:
  std::optional<Positions> x_;  // nullopt once anchors and rules are made
  std::vector<ViewAnchor> anchors_;
  std::vector<ApexRule> apex_rules_;
  double work_ = 0;  // until anchors and rules are made, a lower bound of the work to make them
};

// The data that a detector keeps for its mesh: the results of preprocessing, and the working memory
// of steps.
struct StepContext {
  Options options;
  Stages stages;
  Surface surface;
  BoundingVolumeTree tree;                  // of the mesh
  SearchMemory search;                      // with the marks of the tree
  std::unique_ptr<MeshSearch> pair_search;  // made by stages.pair_search
  FirstViews views;
  std::optional<std::uint64_t> adjacent_pairs;  // once the cost model needs it (culling_policy.h)
  Workers workers;
  PairRelation relation;
};

// The question that a step answers.
struct StepQuestion {
  Pairs pairs;
  double until = 1;  // with Pairs::first: contacts after this time are not looked for
};

// Answers the step. It goes on from `state`, the state of the last commit, if there is one. If the
// answer is free or collision, and question.until is 1, sets `next` to the state at the end of the
// step; otherwise `next` stays empty. REQUIRES that `next` is empty.
StepResult evaluate_step(StepContext& context, const std::optional<StepState>& state,
                         const SteppedMesh& mesh, const StepQuestion& question,
                         std::span<const ViewPrimitive> primitives, const StopFunction& stop,
                         std::optional<StepState>& next);

}  // namespace assay::detector
