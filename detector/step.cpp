// Algorithm 3 of the thesis with what THEORY adds to it (its closed part is Algorithm 1). The steps
// stand in this order below; each is a stage.
//
//   apexes of the ghost fans, for an unclosed mesh                 BoundaryHandler (L11)
//   view test of every component and its ghosts from its primitive ViewClassifier (L1, L2)
//   component all positive and winding number 1: free, clean       ReleaseRule (L5)
//   all components free and only one of them: done, no tree is touched
//   state at the start: last commit, or static contacts and layers ReleaseRule (L8, L9)
//   ghosts against the mesh, hole by hole: violated                BoundaryHandler (L11)
//   mark the triangles that changed                                Marking
//   traverse (V+,V-), (U,V0), (U,Vv) and pairs of two components   PairRule, PairSearch (L3, L10)
//   elementary tests, each feature pair once                       ElementaryTest
//   closure: (U,H) until H is stable                               PairRule (L7)
//   what is clean at the end                                       ReleaseRule (L8)
#include "detector/step.h"

#include <algorithm>
#include <cmath>

#include "detector/mesh/mesh_checks.h"
#include "detector/stopwatch.h"

namespace assay::detector {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

class Step {
 public:
  Step(StepContext& context, const StepState* known, const PositionsView& x_t0,
       const PositionsView& x_t1, const StopFunction& stop)
      : context_(context),
        mesh_(context.surface.mesh),
        work_{context.surface,
              context.tree,
              *context.stages.boundary,
              *context.stages.elementary,
              stop,
              x_t0,
              x_t1,
              known,
              {},
              {},
              {},
              {},
              {},
              {}} {}

  // primitives: none, one, or one for each component.
  StepResult run(const PositionsView& mesh_x_t0, const PositionsView& mesh_x_t1,
                 std::span<const ViewPrimitive> primitives, std::optional<StepState>& next) {
    if (context_.uses_views()) place_primitives(mesh_x_t0, mesh_x_t1, primitives);
    const bool completed = run_stages();
    result_.answer = !completed              ? Answer::undecided
                     : result_.pairs.empty() ? Answer::free
                                             : Answer::collision;
    if (completed) next = state_at_end(mesh_x_t1);  // whole or not at all, should memory fail
    set_first_time();
    hand_over();
    return std::move(result_);
  }

 private:
  // Nothing is before the least lo, and each hi below 1 is one by which there is a contact. Of
  // unique enclosures this is the least.
  void set_first_time() {
    if (result_.pairs.empty()) return;
    result_.first = result_.pairs.front().time;
    for (const auto& [pair, time, feature] : result_.pairs) {
      result_.first.lo = std::min(result_.first.lo, time.lo);
      result_.first.hi = std::min(result_.first.hi, time.hi);
    }
  }

  void place_primitives(const PositionsView& x_t0, const PositionsView& x_t1,
                        std::span<const ViewPrimitive> given) {
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      work_.primitives.push_back(given.empty()       ? place_view(context_.anchors[c], x_t0, x_t1)
                                 : given.size() == 1 ? given[0]
                                                     : given[c]);
    }
  }

  bool run_stages() {
    work_.clean.assign(mesh_.triangles.size(), 0);
    work_.touched.assign(mesh_.triangles.size(), 0);
    work_.free.assign(mesh_.components.size(), 0);
    if (context_.uses_views()) {
      classify_components();
      if (!find_start()) return false;
      const bool all_free = work_.all_free();
      if (!all_free && !sweep_ghosts()) return false;
      count_sets();
      if (all_free && mesh_.components.size() == 1) return true;
    }
    return search();
  }

  void classify_components() {
    Stopwatch watch(result_.times.view_test);
    work_.signs.assign(work_.surface.all().triangles.size(), ViewSign::zero);
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      context_.stages.classifier->classify(work_.surface.all(), work_.component(c), work_.x_t0,
                                           work_.x_t1, work_.primitives[c], work_.signs,
                                           work_.counts.view);
      work_.free[c] = context_.stages.release->is_free(work_, c);
      work_.counts.free_components += work_.free[c];
    }
  }

  // work_.clean at t=0 for all triangles.
  bool find_start() {
    Stopwatch watch(result_.times.start);
    if (work_.all_free()) {
      std::fill(work_.clean.begin(), work_.clean.end(), 1);
      return true;
    }
    const ReleaseRule& release = *context_.stages.release;
    std::vector<std::int32_t> to_release, to_verify;
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      bool all_clean = work_.free[c] != 0;
      if (!all_clean && work_.known) {
        all_clean = true;
        for (const auto t : work_.own_triangles(c)) {
          work_.clean[at(t)] = work_.known->clean[at(t)];
          all_clean &= work_.clean[at(t)] != 0;
        }
        if (!all_clean) to_release.push_back(static_cast<std::int32_t>(c));
      } else if (!all_clean && context_.options.start == Start::clean) {
        all_clean = true;
      } else if (!all_clean && context_.options.start == Start::verified) {
        all_clean = release.released_at_start(work_, c);
        if (!all_clean) to_verify.push_back(static_cast<std::int32_t>(c));
      }
      if (all_clean) {
        for (const auto t : work_.own_triangles(c)) work_.clean[at(t)] = 1;
      }
    }
    return (to_release.empty() || release.release(work_, to_release)) &&
           (to_verify.empty() || release.verify_start(work_, to_verify));
  }

  bool sweep_ghosts() {
    if (work_.surface.is_closed()) return true;
    Stopwatch watch(result_.times.ghosts);
    work_.tree.refit(mesh_, work_.x_t0, work_.x_t1);
    const GhostSweep sweep{work_.surface, work_.tree,       work_.x_t0,
                           work_.x_t1,    work_.elementary, !work_.known};
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      if (work_.free[c]) continue;
      if (!work_.boundary.sweep(sweep, work_.ghosts(c), work_.stop, work_.touched,
                                work_.counts.ghosts)) {
        return false;
      }
    }
    return true;
  }

  void count_sets() {
    const std::size_t count = mesh_.triangles.size();
    result_.doubts.assign(count, 0);
    if (work_.all_free()) {  // and so clean, and touched by no ghost
      result_.view_positive = count;
      return;
    }
    for (std::size_t t = 0; t < count; ++t) {
      const bool dirty = !work_.clean[t], violated = work_.touched[t] != 0;
      result_.doubts[t] =
          static_cast<std::uint8_t>((violated ? doubt::violated : 0) | (dirty ? doubt::dirty : 0));
      result_.dirty += dirty;
      result_.violated += violated;
      if (dirty || violated) {
        ++result_.against_all;
      } else if (work_.signs[t] == ViewSign::positive) {
        ++result_.view_positive;
      } else if (work_.signs[t] == ViewSign::negative) {
        ++result_.view_negative;
      } else {
        ++result_.view_zero;
      }
    }
  }

  TriangleType type_of(std::size_t t) const {
    if (!work_.clean[t]) return TriangleType::dirty;
    if (work_.touched[t]) return TriangleType::violated;
    return work_.signs[t] == ViewSign::positive   ? TriangleType::positive
           : work_.signs[t] == ViewSign::negative ? TriangleType::negative
                                                  : TriangleType::zero;
  }

  bool search() {
    std::vector<TriangleType> types(mesh_.triangles.size());
    for (std::size_t t = 0; t < types.size(); ++t) types[t] = type_of(t);
    StepTimes& times = result_.times;
    const Stages& stages = context_.stages;
    const SearchStages search_stages{*stages.pair_rule, *stages.marking, *stages.pair_search,
                                     *stages.elementary};
    {
      Stopwatch watch(times.broad_phase);
      stages.pair_search->fit(work_.tree, mesh_, work_.x_t0, work_.x_t1);
    }
    CandidateSearch candidates(search_stages, mesh_, work_.tree, context_.search, work_.x_t0,
                               work_.x_t1, work_.stop);
    bool completed = true;
    {
      Stopwatch watch(times.broad_phase);
      candidates.mark(types);
      completed = candidates.collect();
    }
    // The tests are made as candidates come up.
    times.narrow_phase = candidates.contacts().test_time();
    times.broad_phase -= times.narrow_phase;
    if (completed && context_.uses_views() && context_.options.pairs == Pairs::all) {
      Stopwatch watch(times.closure);
      completed = candidates.close();
    }
    result_.pairs = candidates.contacts().pair_contacts();
    work_.counts.search = candidates.search_counts();
    work_.counts.marking = candidates.marking_counts();
    work_.counts.narrow = candidates.contacts().counts();
    work_.counts.closure_rounds = candidates.closure_rounds();
    return completed;
  }

  StepState state_at_end(const PositionsView& mesh_x_t1) const {
    StepState state;
    state.keep(mesh_x_t1);
    state.inside.resize(mesh_.components.size());
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      if (work_.free[c]) state.inside[c] = {work_.primitives[c].q0.t1, work_.primitives[c].q1.t1};
    }
    const bool complete = !context_.uses_views() || context_.options.pairs == Pairs::all;
    context_.stages.release->settle(work_, result_.pairs, complete, state);
    return state;
  }

  void hand_over() {
    result_.signs = std::move(work_.signs);
    result_.primitives = std::move(work_.primitives);
    result_.counts = work_.counts;
  }

  StepContext& context_;
  const Topology& mesh_;
  StepWork work_;
  StepResult result_;
};

StepResult refused(Problem problem) {
  StepResult result;
  result.answer = Answer::error;
  result.problem = std::move(problem);
  return result;
}

std::optional<Problem> check_input(const StepContext& context, const PositionsView& x_t0,
                                   const PositionsView& x_t1,
                                   std::span<const ViewPrimitive> primitives) {
  for (const auto* x : {&x_t0, &x_t1}) {
    if (auto problem = check_positions(*x, context.surface.first_apex)) return problem;
  }
  const auto components = context.surface.mesh.components.size();
  if (primitives.size() > 1 && primitives.size() != components) {
    return Problem{InputError::wrong_primitive_count,
                   std::to_string(primitives.size()) + " view primitives for " +
                       std::to_string(components) + " components"};
  }
  for (const auto& primitive : primitives) {
    for (const auto* point :
         {&primitive.q0.t0, &primitive.q0.t1, &primitive.q1.t0, &primitive.q1.t1}) {
      if (!std::all_of(point->begin(), point->end(), [](double c) { return std::isfinite(c); })) {
        return Problem{InputError::non_finite_coordinate, "a view primitive is not finite"};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

StepResult evaluate_step(StepContext& context, const std::optional<StepState>& known,
                         const PositionsView& x_t0, const PositionsView& x_t1,
                         std::span<const ViewPrimitive> primitives, const StopFunction& stop,
                         std::optional<StepState>& next) {
  if (auto problem = check_input(context, x_t0, x_t1, primitives))
    return refused(std::move(*problem));
  const StepState* state =
      known && context.stages.release->still_holds(*known, x_t0) ? &*known : nullptr;
  double total = 0;
  StepResult result;
  {
    Stopwatch watch(total);
    if (context.surface.is_closed() || !context.uses_views()) {
      result = Step(context, state, x_t0, x_t1, stop).run(x_t0, x_t1, primitives, next);
    } else {
      auto apexes =
          context.stages.boundary->place_apexes(context.surface, context.apex_rules, x_t0, x_t1);
      const Positions all_t0 = with_apexes(x_t0, apexes, false);
      const Positions all_t1 = with_apexes(x_t1, apexes, true);
      result = Step(context, state, all_t0, all_t1, stop).run(x_t0, x_t1, primitives, next);
      result.apexes = std::move(apexes);
    }
  }
  result.times.total = total;
  return result;
}

}  // namespace assay::detector
