// One step under way: what it was given, what it has marked and counted so far, and a function for
// each line of the algorithm. step.cpp states the algorithm and calls them in its order.
//
// A function whose work may be stopped returns whether it went to its end; the others say what they
// return. Functions that serve views alone do nothing in a step without views.
#pragma once

#include <optional>

#include "detector/step/culling_policy.h"
#include "detector/step/step.h"

namespace assay::detector {

class StepRun {
 public:
  // `motion`: of the mesh, and of its apexes if the ghosts move in this step. The references must
  // outlive this object.
  StepRun(StepContext& context, const StepState* last_state, const SteppedMesh& motion,
          const StepQuestion& question, CullingPolicy& policy, const StopFunction& stop);

  // Places the primitives, if they are due. `mesh` is the motion of the mesh alone; `input` holds
  // no primitive, one, or one for each component.
  bool place_primitives(const SteppedMesh& mesh, std::span<const ViewPrimitive> input);
  // Gives each triangle its sign, and shows which components are free (L5). Afterwards the step
  // has views, if they are due and worth the view test.
  bool classify_components();
  // Whether the ghosts are worth a sweep. It is true also if all components are free, because they
  // need none, and with a culling without views, because it has no views to drop.
  bool pays_to_sweep();
  // Finds out which triangles are clean at t=0 (L8, L9).
  bool find_start();
  // Whether the views still pay, now that it is known what is dirty.
  bool pays_to_use();
  // The rest of the step is that of culling bvh. What is clean is set back to what was known
  // before the step, because the result of a step without views shows no view primitive, and
  // whoever keeps account of the state from results could not follow a release from one.
  void drop_views();
  // Finds the triangles that ghosts touch (L11).
  bool sweep_ghosts();
  // Whether the one component of the mesh is free, so that nothing is left to search. Now that all
  // sets are known, it counts them for the result.
  bool ends_free();

  // Gives each triangle its type, and marks the tree.
  bool mark_types();
  // Fits the boxes of the tree to the step, finds the candidates, and tests them as they come up;
  // or tests what an earlier question has left, if that is all (L20).
  bool find_pairs();
  // Closes the set of pairs (L7), if all pairs are asked for, or if K has found a contact within a
  // component that does not count. Without the closure a later one that counts could then be
  // missed, because L3 speaks of all contacts (L19).
  bool close_pairs();

  // The result. If the step was completed, and was asked about to its end, `next` is set to the
  // state there (L8). The flag has_own_primitives says that the caller gave no primitives.
  StepResult finish(bool completed, const SteppedMesh& mesh, bool has_own_primitives,
                    std::optional<StepState>& next);

 private:
  // What the search found goes into the result, also if it was stopped. False if it was stopped
  // while contacts were sorted into those that count and others.
  bool take_found();
  // Whether what is near is kept for a next question. Where times are not unique, it would depend
  // on it which pairs are found.
  bool keeps_near() const {
    return context_.options.keeps_near && context_.options.arithmetic == Arithmetic::exact &&
           !marks_.has_views();
  }
  // Whether the first contact alone is looked for.
  bool looks_for_first() const { return question_.pairs == Pairs::first; }
  TimeBound by_time(double until) const {
    return {until, context_.options.arithmetic == Arithmetic::exact};
  }
  // Leaves, of the pairs that count, those in contact by the upper end of the first time.
  void keep_first();
  // Whether no contact has cut the search short. A search for the first contact leaves out later
  // ones as soon as it has found one that counts; what it counts then depends on the tree.
  bool is_whole() const { return !looks_for_first() || result_.pairs.empty(); }
  // Whether the pairs found are all that are in contact in the step. A whole search finds what K
  // holds, and with views that is all only if the closure has made it so.
  bool is_complete() const {
    return is_whole() && (!looks_for_first() || !marks_.has_views() || is_closed_);
  }

  StepContext& context_;
  const Topology& mesh_;
  CullingPolicy& policy_;
  const GivenStep step_;
  const StepQuestion question_;
  StepMarks marks_;
  StepCost cost_;
  std::optional<CandidateSearch> search_;  // from mark_types() to finish()
  std::uint64_t candidates_of_k_ = 0;      // before the closure
  bool is_closed_ = false;
  // All contacts found, those that do not count too; empty if everything counts.
  std::vector<PairContact> all_contacts_;
  StepResult result_;
};

}  // namespace assay::detector
