// Algorithm 3 of the thesis, self-collision detection with the view-based approach; without what
// it does about holes it is Algorithm 1. The excerpts state most steps in words (3.6, 4.3, 4.4)
// and print no listing. So (r) marks a line that is reconstructed, and + one that the laws of
// detector/README.md add or put in its place. On the right stands what does it here; a step runs
// through these functions in this order.
//
//   in preprocessing                                             assemble
//     (r) build a BVH of the mesh
//         for each hole, ghost triangles over it
//     +     a fan over each boundary loop, its apex above it     BoundaryHandler (L11, L12)
//         compute a view primitive inside the object
//     +     anywhere, and one for each component                 make_view_anchor (L10)
//   in each step
//     (r) move the ghosts and the view primitive                 place_apexes, place_primitives
//         divide all triangles into V+, V- and V0 by view tests  classify_components (L1, L2)
//     +     ghosts are seen too
//         if all triangles are in V+: self-collision free
//     +     a component, with its ghosts, and winding number 1   ReleaseRule (L5)
//     +     ends the step if there is one component alone
//     +   no views where they do not pay: every pair is tested   CullingPolicy
//     +   what is clean at the start: last commit, or layers     find_start (L8, L9)
//         hole by hole: pairs of the BVH and the ghosts,
//           elementary tests; what is in contact goes into Vv    sweep_ghosts (L11)
//     (r) refit the boxes of the BVH                             PairSearch
//         mark the triangles whose type has changed: the vBVHs   Marking
//         traverse (V+,V-), (U,V0) and (U,Vv), passing over
//           nodes with a single child                            PairRule, PairSearch (L3)
//     +     and the pairs of two components                      (L10)
//     (r) elementary tests of the pairs found                    ElementaryTest
//     +   closure: (U,H) until H is stable                       PairRule (L7)
//         free: Vv is released
//     +     Vv is what is not known to be clean                  ReleaseRule (L8)
#include "detector/step/step.h"

#include <algorithm>

#include "detector/parallel/for_all.h"
#include "detector/parallel/shared_stop.h"
#include "detector/search/stopwatch.h"
#include "detector/step/clean_triangles.h"
#include "detector/step/cost_model.h"
#include "detector/step/step_end.h"
#include "detector/step/step_input.h"
#include "detector/step_result.h"

namespace assay::detector {
namespace {

class Step {
 public:
  Step(StepContext& context, const StepState* known, const SteppedMesh& motion,
       CullingPolicy& policy, const StopFunction& stop)
      : context_(context),
        mesh_(context.surface.mesh),
        policy_(policy),
        given_{context.surface,
               context.tree,
               *context.stages.boundary,
               *context.stages.elementary,
               stop,
               motion,
               known},
        cost_{.pace = PacedStop(stop, context.workers)} {}

  // primitives: none, one, or one for each component.
  StepResult run(const SteppedMesh& mesh, std::span<const ViewPrimitive> primitives,
                 std::optional<StepState>& next) {
    if (policy_.is_due()) place_primitives(mesh, primitives);
    const bool completed = !cost_.pace.stopped() && run_stages();
    result_.answer = !completed              ? Answer::undecided
                     : result_.pairs.empty() ? Answer::free
                                             : Answer::collision;
    if (completed)
      next = state_at_end(given_, marks_, cost_.pace, *context_.stages.release, result_.pairs,
                          is_complete(),
                          mesh.vertices_t1);  // set whole or, if memory fails, not at all
    if (next) next->policy = policy_.next(cost_.counts, primitives.empty());
    result_.first = least_time(result_.pairs);
    if (completed) result_.views = policy_.use();
    hand_over();
    return std::move(result_);
  }

 private:
  void place_primitives(const SteppedMesh& motion, std::span<const ViewPrimitive> given) {
    if (given.empty()) {
      constexpr std::uint64_t work_of_anchor = 10;
      for (const auto& anchor :
           policy_.anchors(context_.anchors, given_.motion.vertices_t0, cost_.pace)) {
        if (cost_.pace.after(work_of_anchor)) return;
        marks_.primitives.push_back(place_view(anchor, motion));
      }
    } else if (given.size() == 1) {
      marks_.primitives.assign(mesh_.components.size(), given[0]);
    } else {
      marks_.primitives.assign(given.begin(), given.end());
    }
  }

  bool run_stages() {
    marks_.clean.assign(mesh_.triangles.size(), 0);
    marks_.touched.assign(mesh_.triangles.size(), 0);
    marks_.free.assign(mesh_.components.size(), 0);
    if (policy_.is_due() && policy_.worth_classifying(given_, marks_) && !classify_components())
      return false;
    if (policy_.may_use_views() && !marks_.all_free() &&
        !(marks_.has_views() && policy_.worth_sweeping(given_, marks_, cost_.pace))) {
      drop_views();
    }
    if (marks_.has_views()) {
      if (!find_start()) return false;
      if (!marks_.all_free() && !policy_.worth_using(given_, marks_, cost_.counts)) drop_views();
    }
    if (marks_.has_views()) {
      const bool all_free = marks_.all_free();
      if (!all_free && !sweep_ghosts()) return false;
      count_sets(marks_, result_);
      if (all_free && mesh_.components.size() == 1) return true;
    }
    return search();
  }

  // The rest of the step is that of culling bvh. What is clean is set back to what was known
  // before the step, because the result of a step without views shows no view primitive, and
  // whoever keeps account of the state from results could not follow a release from one.
  void drop_views() {
    take_clean_at_start(given_, marks_, context_.options.start);
    marks_.signs.clear();
    marks_.primitives.clear();
    std::fill(marks_.free.begin(), marks_.free.end(), 0);
    cost_.counts.free_components = 0;
  }

  bool classify_components() {
    Stopwatch watch(result_.times.view_test);
    marks_.signs.assign(given_.surface.all().triangles.size(), ViewSign::zero);
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      // The classifier counts the work of signs itself; this is what the component takes besides.
      constexpr std::uint64_t work_beside_signs = 200;
      if (!context_.stages.classifier->classify(given_.surface.all(), given_.component(c),
                                                given_.motion, marks_.primitives[c], marks_.signs,
                                                cost_.counts.view, cost_.pace)) {
        return false;
      }
      if (cost_.pace.after(work_beside_signs)) return false;
      marks_.free[c] = context_.stages.release->is_free(given_, marks_, cost_, c);
      if (cost_.pace.stopped()) return false;
      cost_.counts.free_components += marks_.free[c];
    }
    return true;
  }

  bool find_start() {
    Stopwatch watch(result_.times.start);
    return find_clean_at_start(given_, marks_, cost_, *context_.stages.release,
                               context_.options.start, policy_.start_by());
  }

  bool sweep_ghosts() {
    if (given_.surface.is_closed()) return true;
    Stopwatch watch(result_.times.ghosts);
    if (!given_.tree.refit(mesh_, given_.motion, cost_.pace)) return false;
    GhostSweep sweep{given_.surface, given_.tree, given_.motion, given_.elementary, !given_.known};
    marks_.near_ghosts.assign(mesh_.triangles.size(), 0);
    sweep.near = &marks_.near_ghosts;
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      if (marks_.free[c]) continue;
      constexpr std::uint64_t work_of_sweep = 200;
      if (cost_.pace.after(work_of_sweep)) return false;
      if (!given_.boundary.sweep(sweep, given_.ghosts(c), given_.stop, marks_.touched,
                                 cost_.counts.ghosts)) {
        return false;
      }
    }
    const auto& near = marks_.near_ghosts;
    cost_.counts.ghosts.near_triangles =
        static_cast<std::uint64_t>(std::count(near.begin(), near.end(), 1));
    return true;
  }

  bool search() {
    std::vector<TriangleType> types(mesh_.triangles.size());
    constexpr std::uint64_t work_of_type = 1;
    for_all_paced(types.size(), work_of_type, cost_.pace,
                  [&](std::size_t t) { types[t] = type_of(marks_, t); });
    StepTimes& times = result_.times;
    const Stages& stages = context_.stages;
    const SearchStages search_stages{*stages.pair_rule, *stages.marking, *context_.pair_search,
                                     *stages.elementary};
    {
      Stopwatch watch(times.broad_phase);
      if (!context_.pair_search->fit(given_.tree, mesh_, given_.motion, cost_.pace)) {
        return false;
      }
    }
    CandidateSearch candidates(search_stages, mesh_, given_.tree, context_.search, given_.motion,
                               cost_.pace);
    bool completed = true;
    {
      Stopwatch watch(times.broad_phase);
      completed =
          candidates.mark(types) && candidates.collect(policy_.worth_proving(marks_, candidates));
    }
    // Tests are made as candidates come up, so their time is part of the time measured above.
    times.narrow_phase = candidates.test_time();
    times.broad_phase -= times.narrow_phase;
    const auto candidates_of_k = candidates.search_counts().candidate_pairs;
    if (completed && marks_.has_views() && context_.options.pairs == Pairs::all) {
      Stopwatch watch(times.closure);
      completed = candidates.close();
    }
    result_.pairs = candidates.take_contacts();
    cost_.counts.search = candidates.search_counts();
    cost_.counts.marking = candidates.marking_counts();
    cost_.counts.narrow = candidates.narrow_counts();
    cost_.counts.closure_rounds = candidates.closure_rounds();
    if (marks_.has_views()) policy_.record_cost(cost_.counts, candidates_of_k);
    return completed;
  }

  // Whether the pairs found are all that are in contact in the step.
  bool is_complete() const { return !marks_.has_views() || context_.options.pairs == Pairs::all; }

  void hand_over() {
    result_.signs = std::move(marks_.signs);
    result_.primitives = std::move(marks_.primitives);
    result_.counts = cost_.counts;
  }

  StepContext& context_;
  const Topology& mesh_;
  CullingPolicy& policy_;
  const GivenStep given_;
  StepMarks marks_;
  StepCost cost_;
  StepResult result_;
};

// The policy of the culling asked for, made without allocating.
class PolicyOfStep {
 public:
  PolicyOfStep(const StepContext& context, const std::optional<StepState>& known)
      : PolicyOfStep(context, known ? known->policy : PolicyState{}) {}
  CullingPolicy& policy() {
    if (model_) return *model_;
    return fixed_;
  }

 private:
  PolicyOfStep(const StepContext& context, const PolicyState& before)
      : fixed_(context.options.culling, before) {
    if (chooses_views(context.options.culling))
      model_.emplace(context.surface, context.adjacent_pairs, before);
  }
  FixedPolicy fixed_;
  std::optional<CostModel> model_;
};

StepResult undecided() {
  StepResult result;
  result.answer = Answer::undecided;
  return result;
}

}  // namespace

StepResult evaluate_step(StepContext& context, const std::optional<StepState>& known,
                         const SteppedMesh& motion, std::span<const ViewPrimitive> primitives,
                         const StopFunction& asked, std::optional<StepState>& next) {
  SharedStop shared(asked);
  const StopFunction stop = shared.function();
  PacedStop pace(stop, context.workers);
  if (auto problem = check_step_input(context.surface, motion, primitives, pace))
    return refused(std::move(*problem));
  const StepState* state =
      known && context.stages.release->still_holds(*known, motion.vertices_t0, pace) ? &*known
                                                                                     : nullptr;
  PolicyOfStep policy_of_step(context, known);
  CullingPolicy& policy = policy_of_step.policy();
  double total = 0;
  StepResult result;
  {
    Stopwatch watch(total);
    if (context.surface.is_closed() || !policy.is_due()) {
      result = Step(context, state, motion, policy, stop).run(motion, primitives, next);
    } else {
      constexpr std::uint64_t work_of_ghost = 10, work_of_vertex = 3;
      auto apexes =
          context.stages.boundary->place_apexes(context.surface, context.apex_rules, motion);
      if (pace.after(work_of_ghost * context.surface.ghost_count())) return undecided();
      const Positions all_t0 = with_apexes(motion.vertices_t0, apexes, false);
      if (pace.after(work_of_vertex * at(context.surface.first_apex))) return undecided();
      const Positions all_t1 = with_apexes(motion.vertices_t1, apexes, true);
      result = Step(context, state, {all_t0, all_t1}, policy, stop).run(motion, primitives, next);
      if (!result.primitives.empty()) result.apexes = std::move(apexes);
    }
  }
  result.times.total = total;
  return result;
}

}  // namespace assay::detector
