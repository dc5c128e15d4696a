#include "detector/step/step_run.h"

#include <algorithm>
#include <span>

#include "detector/mesh/for_all.h"
#include "detector/search/stopwatch.h"

namespace assay::detector {
namespace {

// Returns the type, which follows from the sign, the state and the ghosts. A triangle that is dirty
// or touched by a ghost gets that type whatever its sign is, because Vv is tested against
// everything. Without views every clean triangle gets the type `violated`.
TriangleType type_of(const StepMarks& marks, std::size_t t) {
  if (!marks.clean[t]) return TriangleType::dirty;
  // A type that is tested against everything, but, unlike `dirty`, not for piercing its own
  // component at t=0: clean triangles pierce nothing there.
  if (!marks.has_views()) return TriangleType::violated;
  if (marks.touched[t]) return TriangleType::violated;
  return marks.signs[t] == ViewSign::positive   ? TriangleType::positive
         : marks.signs[t] == ViewSign::negative ? TriangleType::negative
                                                : TriangleType::zero;
}

// Sets the sizes of V+, V-, V0 and Vv and the doubts in the result. REQUIRES a step with views.
void count_sets(const StepMarks& marks, bool looks_everywhere, StepResult& result) {
  const std::size_t count = marks.clean.size();
  result.doubts.assign(count, 0);
  // All is then positive, clean and touched by no ghost.
  if (marks.all_free() && looks_everywhere) {
    result.view_positive = count;
    return;
  }
  for (std::size_t t = 0; t < count; ++t) {
    const bool dirty = !marks.clean[t], violated = marks.touched[t] != 0;
    result.doubts[t] =
        static_cast<std::uint8_t>((violated ? doubt::violated : 0) | (dirty ? doubt::dirty : 0));
    result.dirty += dirty;
    result.violated += violated;
    switch (type_of(marks, t)) {
      case TriangleType::positive:
        ++result.view_positive;
        break;
      case TriangleType::negative:
        ++result.view_negative;
        break;
      case TriangleType::zero:
        ++result.view_zero;
        break;
      default:
        ++result.against_all;
    }
  }
}

// Returns the enclosure of the first contact time; {0, 0} if there are no pairs.
//
// The enclosure has the least lo and the least hi, each taken by itself. No contact is before the
// least lo, and by each hi below 1 there is a contact. For unique enclosures the result is the
// least of them.
TimeEnclosure least_time(std::span<const PairContact> pairs) {
  if (pairs.empty()) return {};
  TimeEnclosure least = pairs.front().time;
  for (const auto& contact : pairs) {
    least.lo = std::min(least.lo, contact.time.lo);
    least.hi = std::min(least.hi, contact.time.hi);
  }
  return least;
}

// Sets marks.clean of all triangles at t=0, one component after the other. A component that is
// free over the step is clean (L5). Otherwise the state of the last commit decides if it holds at
// t=0 (L8), and some of its dirty triangles may be released (L9). If there is no such state,
// `start` decides; a verified start looks at the component from its view primitive (L5), then at
// its layers (L9). Returns false if stopped.
//
// Layers take about as long as a step of Culling::bvh. With StartBy::view_alone a verified start
// leaves them out. The components that L5 does not show to be clean are then dirty, and the pairs
// of this step tell the next one which triangles are clean (L15).
bool find_clean_at_start(const GivenStep& step, StepMarks& marks, StepCost& cost,
                         const ReleaseRule& release, Start start, StartBy by) {
  if (marks.all_free()) {
    std::fill(marks.clean.begin(), marks.clean.end(), 1);
    return true;
  }
  // The work of L5 on the smallest component, in box tests.
  constexpr std::uint64_t work_of_asking = 200;
  std::vector<std::int32_t> to_release, to_verify;
  for (std::size_t c = 0; c < marks.free.size(); ++c) {
    bool all_clean = marks.free[c] != 0;
    if (!all_clean && step.last_state) {
      all_clean = true;
      for (const auto t : step.own_triangles(c)) {
        marks.clean[at(t)] = step.last_state->clean[at(t)];
        all_clean &= marks.clean[at(t)] != 0;
      }
      if (!all_clean) to_release.push_back(static_cast<std::int32_t>(c));
    } else if (!all_clean && start == Start::clean) {
      all_clean = true;
    } else if (!all_clean && start != Start::unknown) {
      all_clean = release.released_at_start(step, marks, cost, c);
      if (cost.pace.after(work_of_asking)) return false;
      if (!all_clean && by == StartBy::view_and_layers)
        to_verify.push_back(static_cast<std::int32_t>(c));
    }
    if (all_clean) {
      for (const auto t : step.own_triangles(c)) marks.clean[at(t)] = 1;
    }
  }
  return (to_release.empty() || release.release(step, marks, cost, to_release)) &&
         (to_verify.empty() || release.verify_start(step, marks, cost, to_verify));
}

// Returns the state for the next step. `complete` says that `pairs` are all pairs in contact in the
// step (L8). If all components are free it costs little more than a copy of the positions.
StepState state_at_end(const GivenStep& step, const StepMarks& marks, const PacedStop& pace,
                       const ReleaseRule& release, const std::vector<PairContact>& pairs,
                       bool complete, const PositionsView& mesh_x_t1) {
  StepState state;
  state.keep(mesh_x_t1, pace);
  state.inside.resize(step.surface.mesh.components.size());
  for (std::size_t c = 0; c < state.inside.size(); ++c) {
    if (marks.free[c] && step.looks_within(c))
      state.inside[c] = {marks.primitives[c].q0.t1, marks.primitives[c].q1.t1};
  }
  release.settle(step, marks, pairs, complete, state);
  if (marks.has_views()) return state;
  for (std::size_t c = 0; c < state.inside.size(); ++c) {
    if (release.knows_clean(step, pairs, c)) continue;
    if (state.inside.size() == 1) {  // its triangles are all triangles
      std::fill(state.clean.begin(), state.clean.end(), 0);
    } else {
      for (const auto t : step.own_triangles(c)) state.clean[at(t)] = 0;
    }
  }
  return state;
}

}  // namespace

StepRun::StepRun(StepContext& context, const StepState* last_state, const SteppedMesh& motion,
                 const StepQuestion& question, CullingPolicy& policy, const StopFunction& stop)
    : context_(context),
      mesh_(context.surface.mesh),
      policy_(policy),
      step_{.surface = context.surface,
            .tree = context.tree,
            .boundary = *context.stages.boundary,
            .elementary = *context.stages.elementary,
            .stop = stop,
            .motion = motion,
            .last_state = last_state,
            .relation = context.relation.count_all() ? nullptr : &context.relation},
      question_(question),
      cost_{.pace = PacedStop(stop, context.workers)} {
  context_.tree.forget_fit();  // the caller may have written new positions into the same arrays
  marks_.clean.assign(mesh_.triangles.size(), 0);
  marks_.touched.assign(mesh_.triangles.size(), 0);
  marks_.free.assign(mesh_.components.size(), 0);
}

bool StepRun::place_primitives(const SteppedMesh& mesh, std::span<const ViewPrimitive> input) {
  if (!policy_.is_due()) return true;
  auto& primitives = marks_.primitives;
  if (input.empty()) {
    constexpr std::uint64_t work_of_anchor = 10;
    for (const auto& anchor :
         policy_.anchors(context_.views.anchors(), step_.motion.vertices_t0, cost_.pace)) {
      if (cost_.pace.after(work_of_anchor)) return false;
      primitives.push_back(place_view(anchor, mesh));
    }
  } else if (input.size() == 1) {
    primitives.assign(mesh_.components.size(), input[0]);
  } else {
    primitives.assign(input.begin(), input.end());
  }
  return !cost_.pace.stopped();
}

bool StepRun::classify_components() {
  if (!policy_.is_due() || !policy_.worth_classifying(step_, marks_)) return true;
  Stopwatch watch(result_.times.view_test);
  marks_.signs.assign(step_.surface.all().triangles.size(), ViewSign::zero);
  for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
    if (!step_.looks_within(c)) {
      marks_.free[c] = 1;
      continue;
    }
    // The classifier counts the work of signs itself; this is the other work on a component.
    constexpr std::uint64_t work_beside_signs = 200;
    const bool is_classified = context_.stages.classifier->classify(
        step_.surface.all(), step_.component(c), step_.motion, marks_.primitives[c], marks_.signs,
        cost_.counts.view, cost_.pace);
    if (!is_classified || cost_.pace.after(work_beside_signs)) return false;
    marks_.free[c] = context_.stages.release->is_free(step_, marks_, cost_, c);
    if (cost_.pace.stopped()) return false;
    cost_.counts.free_components += marks_.free[c];
  }
  return true;
}

bool StepRun::pays_to_sweep() {
  return !policy_.may_use_views() || marks_.all_free() ||
         (marks_.has_views() && policy_.worth_sweeping(step_, marks_, cost_.pace));
}

bool StepRun::pays_to_use() {
  return !marks_.has_views() || marks_.all_free() ||
         policy_.worth_using(step_, marks_, cost_.counts);
}

void StepRun::drop_views() {
  // Uses only what is known already. Without a committed state or the caller's word (Start::clean)
  // all triangles are dirty. Nothing is lost by that: the step tests every pair anyway, and from
  // its pairs the next step releases the clean triangles (L15).
  const Start start = context_.options.start;
  if (step_.last_state) {
    marks_.clean = step_.last_state->clean;
  } else {
    std::fill(marks_.clean.begin(), marks_.clean.end(), start == Start::clean ? 1 : 0);
  }
  marks_.signs.clear();
  marks_.primitives.clear();
  std::fill(marks_.free.begin(), marks_.free.end(), 0);
  cost_.counts.free_components = 0;
}

bool StepRun::find_start() {
  if (!marks_.has_views()) return true;
  Stopwatch watch(result_.times.start);
  return find_clean_at_start(step_, marks_, cost_, *context_.stages.release, context_.options.start,
                             policy_.start_by());
}

bool StepRun::sweep_ghosts() {
  if (!marks_.has_views() || marks_.all_free() || step_.surface.is_closed()) return true;
  Stopwatch watch(result_.times.ghosts);
  if (!step_.tree.fit_once(mesh_, step_.motion, cost_.pace)) return false;
  if (!step_.tree.join_boxes(&cost_.pace)) return false;
  GhostSweep sweep{step_.surface, step_.tree, step_.motion, step_.elementary, !step_.last_state};
  marks_.near_ghosts.assign(mesh_.triangles.size(), 0);
  sweep.near = &marks_.near_ghosts;
  sweep.workers = cost_.pace.workers();
  for (std::size_t c = 0; c < mesh_.components.size(); ++c) {
    if (marks_.free[c]) continue;
    constexpr std::uint64_t work_of_sweep = 200;
    if (cost_.pace.after(work_of_sweep)) return false;
    if (!step_.boundary.sweep(sweep, step_.ghosts(c), step_.stop, marks_.touched,
                              cost_.counts.ghosts)) {
      return false;
    }
  }
  const auto& near = marks_.near_ghosts;
  cost_.counts.ghosts.near_triangles =
      static_cast<std::uint64_t>(std::count(near.begin(), near.end(), 1));
  return true;
}

bool StepRun::ends_free() {
  if (!marks_.has_views()) return false;
  count_sets(marks_, !context_.relation.leaves_out_components(), result_);
  return marks_.all_free() && mesh_.components.size() == 1;
}

bool StepRun::mark_types() {
  std::vector<TriangleType> types(mesh_.triangles.size());
  constexpr std::uint64_t work_of_type = 1;
  for_all_paced(types.size(), work_of_type, cost_.pace,
                [&](std::size_t t) { types[t] = type_of(marks_, t); });
  const Stages& stages = context_.stages;
  search_.emplace(SearchStages{*stages.pair_rule, *stages.marking, *context_.pair_search,
                               *stages.elementary, step_.relation},
                  mesh_, step_.tree, context_.search, step_.motion, cost_.pace);
  if (looks_for_first()) search_->look_for_first(by_time(question_.until), step_.tree);
  Stopwatch watch(result_.times.broad_phase);
  return search_->mark(types);
}

bool StepRun::find_pairs() {
  StepTimes& times = result_.times;
  bool completed = true;
  {
    Stopwatch watch(times.broad_phase);
    const bool keeps = context_.options.keeps_near && !marks_.has_views();
    completed = !keeps || search_->collect_kept();
    if (completed && !(keeps && search_->is_answered())) {
      completed = context_.pair_search->fit(step_.tree, mesh_, step_.motion, cost_.pace) &&
                  search_->collect(policy_.worth_proving(marks_, *search_), keeps);
    }
  }
  // Tests are made as candidates come up, so their time is part of the time measured above.
  times.narrow_phase = search_->test_time();
  times.broad_phase -= times.narrow_phase;
  candidates_of_k_ = search_->search_counts().candidate_pairs;
  return completed;
}

bool StepRun::close_pairs() {
  if (!marks_.has_views()) return true;
  Stopwatch watch(result_.times.closure);
  if (looks_for_first()) {
    const auto ignored = search_->found_ignored();
    if (!ignored) return false;
    if (!*ignored) return true;
  }
  return is_closed_ = search_->close();
}

// Where times are not unique, the pairs that may be in contact at the first time are kept.
void StepRun::keep_first() {
  const TimeBound first = by_time(least_time(result_.pairs).hi);
  std::erase_if(result_.pairs,
                [&](const PairContact& contact) { return first.leaves_out(contact.time); });
}

bool StepRun::take_found() {
  if (!search_) return true;
  bool is_sorted = true;
  result_.pairs = search_->take_contacts();
  if (step_.relation) {
    std::swap(all_contacts_, result_.pairs);
    is_sorted = search_->take_counted(all_contacts_, result_.pairs);
  }
  if (looks_for_first()) keep_first();
  cost_.counts.search = search_->search_counts();
  cost_.counts.marking = search_->marking_counts();
  cost_.counts.narrow = search_->narrow_counts();
  cost_.counts.closure_rounds = search_->closure_rounds();
  if (marks_.has_views() && is_whole()) policy_.record_cost(cost_.counts, candidates_of_k_);
  search_.reset();  // gives its memory back
  return is_sorted;
}

StepResult StepRun::finish(bool completed, const SteppedMesh& mesh, bool has_own_primitives,
                           std::optional<StepState>& next) {
  completed = take_found() && completed;
  // A stop that some stage has heard ends the step, whatever that stage returned.
  completed = completed && !cost_.pace.stopped();
  result_.answer = !completed              ? Answer::undecided
                   : result_.pairs.empty() ? Answer::free
                                           : Answer::collision;
  result_.first = least_time(result_.pairs);
  if (completed) result_.views = policy_.use();
  if (completed && question_.until == 1) {
    const auto& contacts = step_.relation ? all_contacts_ : result_.pairs;
    // Set whole or, if memory fails, not at all.
    next = state_at_end(step_, marks_, cost_.pace, *context_.stages.release, contacts,
                        is_complete(), mesh.vertices_t1);
    StepCounts counts = cost_.counts;
    if (!is_whole()) counts.search = {}, counts.narrow = {};
    next->policy = policy_.next(counts, is_whole() ? contacts.size() : 0, has_own_primitives);
  }
  result_.signs = std::move(marks_.signs);
  result_.primitives = std::move(marks_.primitives);
  result_.counts = cost_.counts;
  return std::move(result_);
}

}  // namespace assay::detector
