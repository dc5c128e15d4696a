// One step under way: its input, its marks and counts so far, and a function for each line of the
// algorithm. step.cpp states the algorithm and calls these functions in its order.
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
  // Returns whether the ghosts are worth a sweep. It also returns true if all components are free,
  // because they need no sweep, and if the culling has no views, because there are none to drop.
  bool pays_to_sweep();
  // Finds out which triangles are clean at t=0 (L8, L9).
  bool find_start();
  // Returns whether the views still pay, now that the dirty triangles are known.
  bool pays_to_use();
  // Makes the step go on as Culling::bvh does. The clean triangles are set back to those known
  // before the step, because the result of a step without views shows no view primitive: a caller
  // that follows the state by results could not follow a release by views.
  void drop_views();
  // Finds the triangles that ghosts touch (L11).
  bool sweep_ghosts();
  // Returns whether the one component of the mesh is free, so that nothing is left to search. Now
  // that all sets are known, it counts them for the result.
  bool ends_free();

  // Gives each triangle its type, and marks the tree.
  bool mark_types();
  // Fits the boxes of the tree to the step, finds the candidates, and tests them as they come up;
  // or tests the feature pairs that an earlier question has kept, if these are all (L20).
  bool find_pairs();
  // Closes the set of pairs (L7), if all pairs are asked for, or if K has found a contact within a
  // component that does not count. Without the closure a later contact that counts could then be
  // missed, because L3 speaks of all contacts (L19).
  bool close_pairs();

  // Returns the result. If the question was about the whole step, and the step was completed, sets
  // `next` to the state at its end (L8). has_own_primitives: the caller gave no primitives.
  StepResult finish(bool completed, const SteppedMesh& mesh, bool has_own_primitives,
                    std::optional<StepState>& next);

 private:
  // Puts the contacts that the search found into the result, also if it was stopped. Returns false
  // if it was stopped while contacts were sorted into those that count and others.
  bool take_found();
  // Returns whether the first contact alone is looked for.
  bool looks_for_first() const { return question_.pairs == Pairs::first; }
  TimeBound by_time(double until) const {
    return {until, context_.options.arithmetic == Arithmetic::exact};
  }
  // Keeps only the counted pairs that are in contact by the upper end of the first time.
  void keep_first();
  // Returns whether no contact has cut the search short. A search for the first contact leaves out
  // later ones as soon as it has found one that counts; its counts then depend on the tree.
  bool is_whole() const { return !looks_for_first() || result_.pairs.empty(); }
  // Returns whether the pairs found are all pairs in contact in the step. A whole search finds the
  // pairs in contact that K holds; with views these are all only after the closure.
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
  // All contacts found, including those that do not count; empty if everything counts.
  std::vector<PairContact> all_contacts_;
  StepResult result_;
};

}  // namespace assay::detector
