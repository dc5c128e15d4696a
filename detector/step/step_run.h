// A step while it is computed: its input, its marks and counts so far, and a function for each line
// of the algorithm. step.cpp lists the algorithm and calls these functions in that order.
//
// A function that can be stopped returns true if it was not stopped; the comments of all other
// functions say what they return. Functions that only serve views do nothing without views.
#pragma once

#include <optional>

#include "detector/step/culling_policy.h"
#include "detector/step/step.h"

namespace assay::detector {

class StepRun {
 public:
  // `motion` is the motion of the mesh, and of the apexes if the step has ghosts. The references
  // must outlive this object.
  StepRun(StepContext& context, const StepState* last_state, const SteppedMesh& motion,
          const StepQuestion& question, CullingPolicy& policy, const StopFunction& stop);

  // Places the view primitives, if views are due. `mesh` is the motion of the mesh without apexes;
  // `input` has no primitive, one, or one for each component.
  bool place_primitives(const SteppedMesh& mesh, std::span<const ViewPrimitive> input);
  // If views are due and worth the view test, gives each triangle its sign, and finds which
  // components are free (L5). The step then has views.
  bool classify_components();
  // Returns whether the ghosts are worth a sweep. Returns true also if all components are free,
  // because these need no sweep, and if the culling has no views to drop.
  bool pays_to_sweep();
  // Finds out which triangles are clean at t=0 (L8, L9).
  bool find_start();
  // Returns whether the views pay, by the dirty triangles that find_start() has found.
  bool pays_to_use();
  // Makes the step go on as with Culling::bvh. The clean triangles are set back to those known
  // before the step. The reason: the result of a step without views has no view primitives, so a
  // caller that computes the state from results could not explain a release by views.
  void drop_views();
  // Finds the triangles that ghosts touch (L11).
  bool sweep_ghosts();
  // Returns whether the mesh has only one component and this component is free, so that nothing
  // needs to be searched. Also counts the view sets for the result, because all of them are known
  // now.
  bool ends_free();

  // Gives each triangle its type, and marks the tree.
  bool mark_types();
  // Fits the boxes of the tree to the step, finds the candidates, and tests them as they are found.
  // If an earlier step has kept all feature pairs that can meet (L20), tests only these.
  bool find_pairs();
  // Does the closure (L7), if all pairs are asked for, or if the search has found, within a
  // component, a contact that does not count. In the second case a later contact that counts could
  // be missed without the closure, because L3 is about all contacts (L19).
  bool close_pairs();

  // Returns the result. If the question is about the whole step, and `completed`, sets `next` to
  // the state at the end of the step (L8). has_own_primitives is true if the caller gave no
  // primitives.
  StepResult finish(bool completed, const SteppedMesh& mesh, bool has_own_primitives,
                    std::optional<StepState>& next);

 private:
  // Puts the contacts that the search found into the result, also if the search was stopped.
  // Returns false if this was stopped while it sorted contacts into those that count and those that
  // do not.
  bool take_found();
  // Returns whether only the first contact is looked for.
  bool looks_for_first() const { return question_.pairs == Pairs::first; }
  TimeBound by_time(double until) const {
    return {until, context_.options.arithmetic == Arithmetic::exact};
  }
  // Removes all pairs from the result except those in contact by the upper end of the first time.
  void keep_first();
  // Returns whether no contact has cut the search short. Once a search for the first contact has
  // found a contact that counts, it leaves out later contacts, and its counts then depend on the
  // tree.
  bool is_whole() const { return !looks_for_first() || result_.pairs.empty(); }
  // Returns whether the pairs found are all pairs in contact in the step. A search that was not cut
  // short finds all pairs in contact that are in K; with views, all pairs in contact are known only
  // after the closure.
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
  // All contacts found, including those that do not count; empty if every pair counts.
  std::vector<PairContact> all_contacts_;
  StepResult result_;
};

}  // namespace assay::detector
