// Algorithm 3 of the thesis with what THEORY adds to it. The steps stand in this order below.
//
//   view test of every closed component from its primitive        classify_components
//   component all positive and winding number 1: free, clean      (L5)
//   all components free and only one of them: done, no tree is touched
//   state at the start: last commit, or static contacts and layers find_start (L8, L9)
//   mark, and traverse (V+,V-), (U,V0), (U,Vv) and pairs of two components
//   elementary tests, each feature pair once                       search (L3, L10)
//   closure: (U,H) until H is stable                               (L7)
//   what is clean at the end                                       state_at_end (L8)
//
// Unclosed components have no view test: all their triangles are dirty, so in (U,Vv).
#include "detector/step.h"

#include <algorithm>
#include <cmath>

#include "detector/mesh/mesh_checks.h"
#include "detector/search/candidate_search.h"
#include "detector/state/winding.h"
#include "detector/stopwatch.h"

namespace assay::detector {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

class Step {
 public:
  Step(StepContext& context, const std::optional<StepState>& known, const PositionsView& x_t0,
       const PositionsView& x_t1, std::span<const ViewPrimitive> primitives,
       const StopFunction& stop)
      : context_(context),
        mesh_(context.mesh),
        x_t0_(x_t0),
        x_t1_(x_t1),
        stop_(stop),
        known_(known && known->holds_at(x_t0) ? &*known : nullptr) {
    place_primitives(primitives);
  }

  StepResult run(std::optional<StepState>& next) {
    const bool completed = run_stages();
    if (!completed) {
      result_.answer = Answer::undecided;
    } else {
      result_.answer = result_.pairs.empty() ? Answer::free : Answer::collision;
      next = state_at_end();  // whole or not at all, should memory fail
    }
    for (const auto& contact : result_.pairs) {
      if (&contact == &result_.pairs.front() || contact.time < result_.first)
        result_.first = contact.time;
    }
    return std::move(result_);
  }

 private:
  bool uses_views() const {
    return context_.options.culling == Culling::view_point ||
           context_.options.culling == Culling::view_line;
  }

  void place_primitives(std::span<const ViewPrimitive> given) {
    if (!uses_views()) return;
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      result_.primitives.push_back(given.empty() ? place_view(context_.anchors[c], x_t0_, x_t1_)
                                   : given.size() == 1 ? given[0]
                                                       : given[c]);
    }
  }

  bool run_stages() {
    clean_.assign(mesh_.triangles.size(), 0);
    free_.assign(mesh_.components.size(), 0);
    if (uses_views()) {
      classify_components();
      if (!find_start()) return false;
      count_sets();
      const bool all_free = std::find(free_.begin(), free_.end(), 0) == free_.end();
      if (all_free && mesh_.components.size() == 1) return true;
    }
    return search();
  }

  void classify_components() {
    Stopwatch watch(result_.times.view_test);
    result_.signs.assign(mesh_.triangles.size(), ViewSign::zero);
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      const Component& component = mesh_.components[c];
      if (!component.is_cycle) continue;
      const ViewPrimitive& primitive = result_.primitives[c];
      classify(mesh_, component.triangles, x_t0_, x_t1_, primitive, result_.signs,
               result_.counts.view);
      const bool all_positive =
          std::all_of(component.triangles.begin(), component.triangles.end(),
                      [&](std::int32_t t) { return result_.signs[at(t)] == ViewSign::positive; });
      if (all_positive && winding_is_one(c, component, primitive)) {
        free_[c] = 1;
        ++result_.counts.free_components;
      }
    }
  }

  bool winding_is_one(std::size_t c, const Component& component, const ViewPrimitive& primitive) {
    const std::array<Point, 2> start = {primitive.q0.t0, primitive.q1.t0};
    if (known_ && known_->inside[c] == start) return true;
    ++result_.counts.winding_numbers;
    return winding_number(mesh_, component.triangles, x_t0_, primitive.q0.t0) == 1;
  }

  // clean_ at t=0 for all triangles.
  bool find_start() {
    Stopwatch watch(result_.times.start);
    std::vector<std::int32_t> to_verify;
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      const Component& component = mesh_.components[c];
      if (!component.is_cycle) continue;
      bool all_clean = free_[c] != 0;
      if (!all_clean && known_) {
        all_clean = true;
        for (const auto t : component.triangles) {
          clean_[at(t)] = known_->clean[at(t)];
          all_clean &= clean_[at(t)] != 0;
        }
        if (!all_clean) all_clean = released_at_start(c);
      } else if (!all_clean && context_.options.start == Start::clean) {
        all_clean = true;
      } else if (!all_clean && context_.options.start == Start::verified) {
        all_clean = released_at_start(c);
        if (!all_clean) to_verify.push_back(static_cast<std::int32_t>(c));
      }
      if (all_clean) {
        for (const auto t : component.triangles) clean_[at(t)] = 1;
      }
    }
    return to_verify.empty() || verify_start(mesh_, context_.tree, x_t0_, to_verify, stop_, clean_);
  }

  bool released_at_start(std::size_t c) const {
    const ViewPrimitive& primitive = result_.primitives[c];
    return released_by_view(mesh_, mesh_.components[c], x_t0_, primitive.q0.t0, primitive.q1.t0);
  }

  void count_sets() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!clean_[t]) {
        ++result_.dirty;
      } else if (result_.signs[t] == ViewSign::positive) {
        ++result_.view_positive;
      } else if (result_.signs[t] == ViewSign::negative) {
        ++result_.view_negative;
      } else {
        ++result_.view_zero;
      }
    }
  }

  std::uint8_t flags_of(std::size_t t) const {
    if (!uses_views()) return 0;
    if (!clean_[t]) return flag::full;
    return result_.signs[t] == ViewSign::positive   ? flag::positive
           : result_.signs[t] == ViewSign::negative ? flag::negative
                                                    : flag::full;
  }

  bool search() {
    const bool uses_tree = context_.options.culling != Culling::none;
    std::vector<std::uint8_t> flags(mesh_.triangles.size());
    for (std::size_t t = 0; t < flags.size(); ++t) flags[t] = flags_of(t);
    StepTimes& times = result_.times;
    {
      Stopwatch watch(times.broad_phase);
      if (uses_tree) context_.tree.refit(mesh_, x_t0_, x_t1_);
    }
    CandidateSearch candidates(mesh_, uses_tree ? &context_.tree : nullptr, x_t0_, x_t1_, clean_,
                               std::move(flags), stop_);
    const PairRule rule = uses_views() ? PairRule::candidates : PairRule::every_pair;
    const bool closes = uses_views() && context_.options.pairs == Pairs::all;
    const bool completed = timed(times.broad_phase, [&] { return candidates.collect(rule); }) &&
                           timed(times.narrow_phase, [&] { return candidates.test(); }) &&
                           (!closes || timed(times.closure, [&] { return candidates.close(); }));
    result_.pairs = candidates.pair_contacts();
    result_.counts.search = candidates.search_counts();
    result_.counts.narrow = candidates.narrow_counts();
    result_.counts.closure_rounds = candidates.closure_rounds();
    return completed;
  }

  template <class Work>
  static bool timed(double& milliseconds, Work work) {
    Stopwatch watch(milliseconds);
    return work();
  }

  StepState state_at_end() const {
    StepState state;
    state.positions = x_t1_;
    state.clean = clean_;
    state.inside.resize(mesh_.components.size());
    for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
      if (free_[c]) state.inside[c] = {result_.primitives[c].q0.t1, result_.primitives[c].q1.t1};
    }
    // Without the complete contact set nothing is known after a collision.
    const bool complete = !uses_views() || context_.options.pairs == Pairs::all;
    for (const auto& contact : result_.pairs) {
      if (!complete) {
        std::fill(state.clean.begin(), state.clean.end(), 0);
      } else if (same_component(contact.pair.a, contact.pair.b)) {
        state.clean[at(contact.pair.a)] = state.clean[at(contact.pair.b)] = 0;
      }
    }
    return state;
  }

  bool same_component(std::int32_t a, std::int32_t b) const {
    return mesh_.component_of_triangle[at(a)] == mesh_.component_of_triangle[at(b)];
  }

  StepContext& context_;
  const Topology& mesh_;
  const PositionsView x_t0_, x_t1_;
  const StopFunction& stop_;
  const StepState* known_;
  std::vector<std::uint8_t> clean_;  // by triangle, at t=0
  std::vector<std::uint8_t> free_;   // by component, by L5
  StepResult result_;
};

StepResult refused(Problem problem) {
  StepResult result;
  result.answer = Answer::error;
  result.problem = std::move(problem);
  return result;
}

}  // namespace

StepResult evaluate_step(StepContext& context, const std::optional<StepState>& known,
                         const PositionsView& x_t0, const PositionsView& x_t1,
                         std::span<const ViewPrimitive> primitives, const StopFunction& stop,
                         std::optional<StepState>& next) {
  for (const auto* x : {&x_t0, &x_t1}) {
    if (auto problem = check_positions(*x, context.vertex_count))
      return refused(std::move(*problem));
  }
  if (primitives.size() > 1 && primitives.size() != context.mesh.components.size()) {
    return refused({InputError::wrong_primitive_count,
                    std::to_string(primitives.size()) + " view primitives for " +
                        std::to_string(context.mesh.components.size()) + " components"});
  }
  for (const auto& primitive : primitives) {
    for (const auto* point :
         {&primitive.q0.t0, &primitive.q0.t1, &primitive.q1.t0, &primitive.q1.t1}) {
      if (!std::all_of(point->begin(), point->end(), [](double c) { return std::isfinite(c); })) {
        return refused({InputError::non_finite_coordinate, "a view primitive is not finite"});
      }
    }
  }
  double total = 0;
  StepResult result;
  {
    Stopwatch watch(total);
    result = Step(context, known, x_t0, x_t1, primitives, stop).run(next);
  }
  result.times.total = total;
  return result;
}

}  // namespace assay::detector
