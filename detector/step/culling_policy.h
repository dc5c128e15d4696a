// What a step asks of its culling: whether it is seen from view primitives, whether it goes on with
// what was seen, and whether patches are worth proving apart.
//
// Every answer is a matter of cost alone, so a policy cannot make a step wrong: a step without
// views tests every pair, and a proof leaves out pairs that are not in contact (L14). A step asks
// in the order of the functions below. After the first no it does without views.
#pragma once

#include <vector>

#include "detector/options.h"
#include "detector/search/candidate_search.h"
#include "detector/state/step_state.h"
#include "detector/step/release_rule.h"
#include "detector/step/step_work.h"
#include "detector/step_result.h"

namespace assay::detector {

// Which triangles are clean at the start of a step, and which at its end.
//
// Sets marks.clean of all triangles at t=0, one component after the other. A component that is
// free over the step is clean (L5). Otherwise the state of the last commit decides if it holds at
// t=0 (L8), and some of its dirty triangles may be released (L9). If there is no such state,
// `start` decides; a verified start looks at the component from its view primitive (L5), then at
// its layers (L9). False if stopped.
//
// Layers take about as long as a step of culling bvh. With StartBy::view_alone a verified start
// leaves them out. The components that L5 does not show to be clean are then dirty, and the pairs
// of this step tell the next one what is clean (L15).
enum class StartBy : std::uint8_t { view_and_layers, view_alone };
bool find_clean_at_start(const GivenStep& step, StepMarks& marks, StepCost& cost,
                         const ReleaseRule& release, Start start,
                         StartBy by = StartBy::view_and_layers);

// Does the same for a step without views. It takes what is known already and looks at nothing.
// Without a committed state or the caller's word (Start::clean) all triangles are dirty. Nothing
// is lost by that: the step tests every pair anyway, and from its pairs the next step releases
// what is clean (L15).
void take_clean_at_start(const GivenStep& step, StepMarks& marks, Start start);

// The state for the next step. `complete` says that `pairs` are all pairs in contact in the step
// (L8). If all components are free it costs little more than a copy of the positions.
StepState state_at_end(const GivenStep& step, const StepMarks& marks, const PacedStop& pace,
                       const ReleaseRule& release, const std::vector<PairContact>& pairs,
                       bool complete, const PositionsView& mesh_x_t1);

class CullingPolicy {
 public:
  virtual ~CullingPolicy() = default;

  // Whether steps of this culling may have views. Then each step follows what is clean, so that a
  // later step with views can rely on it.
  virtual bool may_use_views() const = 0;
  // Whether view primitives are placed in this step.
  virtual bool is_due() const = 0;
  // Where each component is seen from. `first`: the anchors of preprocessing.
  virtual const std::vector<ViewAnchor>& anchors(const std::vector<ViewAnchor>& first,
                                                 const PositionsView& vertices_t0,
                                                 PacedStop& pace) = 0;
  // Whether the triangles are classified. REQUIRES that primitives are placed.
  virtual bool worth_classifying(const GivenStep& step, const StepMarks& marks) = 0;
  // Whether the ghosts are swept. REQUIRES that the triangles are classified.
  virtual bool worth_sweeping(const GivenStep& step, const StepMarks& marks, PacedStop& pace) = 0;
  // How it is found out which triangles are clean at the start.
  virtual StartBy start_by() const = 0;
  // Whether the search goes by views. REQUIRES that it is known which triangles are clean.
  // `counts`: of the step so far.
  virtual bool worth_using(const GivenStep& step, const StepMarks& marks,
                           const StepCounts& counts) = 0;

  // Whether the search proves patches apart. REQUIRES that types are marked.
  virtual bool worth_proving(const StepMarks& marks, CandidateSearch& candidates) = 0;
  // Told after a search with views. `candidates_of_k`: those before the closure.
  virtual void record_cost(const StepCounts& counts, std::uint64_t candidates_of_k) = 0;

  // Whether views were used, as far as that is decided.
  virtual ViewUse use() const = 0;
  // What the policy of the next step begins with. has_own_primitives: the primitives were placed at
  // the policy's anchors; otherwise the caller gave them.
  virtual PolicyState next(const StepCounts& counts, bool has_own_primitives) const = 0;
};

// The cullings that decide nothing: views always (view_point, view_line) or never.
class FixedPolicy : public CullingPolicy {
 public:
  FixedPolicy(Culling culling, PolicyState before)
      : has_views_(uses_views(culling)), state_(std::move(before)) {}

  bool may_use_views() const override { return has_views_; }
  bool is_due() const override { return has_views_; }
  const std::vector<ViewAnchor>& anchors(const std::vector<ViewAnchor>& first, const PositionsView&,
                                         PacedStop&) override {
    return first;
  }
  bool worth_classifying(const GivenStep&, const StepMarks&) override { return true; }
  bool worth_sweeping(const GivenStep&, const StepMarks&, PacedStop&) override { return true; }
  StartBy start_by() const override { return StartBy::view_and_layers; }
  bool worth_using(const GivenStep&, const StepMarks&, const StepCounts&) override { return true; }
  bool worth_proving(const StepMarks&, CandidateSearch&) override { return true; }
  void record_cost(const StepCounts&, std::uint64_t) override {}
  ViewUse use() const override { return has_views_ ? ViewUse::used : ViewUse::not_asked_for; }
  PolicyState next(const StepCounts&, bool) const override { return state_; }

 private:
  bool has_views_;
  PolicyState state_;
};

}  // namespace assay::detector
