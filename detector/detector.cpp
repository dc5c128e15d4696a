#include "detector/detector.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "detector/assembly.h"
#include "detector/boxes/moving_box.h"
#include "detector/mesh/mesh_checks.h"
#include "detector/mesh/paced_stop.h"
#include "detector/parallel/workers.h"
#include "detector/state/step_state.h"
#include "detector/step/step.h"

namespace assay::detector {
namespace {

// Components that no search looks into are not in a state. So a state belongs to the mesh and the
// set of these components, and does not depend on the rest of the relation between pairs.
std::uint64_t digest_of(const StepContext& context) {
  return digest_of(context.surface.mesh, context.surface.first_apex) ^
         context.relation.digest_of_left_out();
}

// Checks the separation. Views and cones prove that there is no contact, but say nothing about
// distances.
std::optional<Problem> check_separation(const Options& options) {
  const double d = options.separation;
  const auto wrong = [](std::string message) {
    return Problem{InputError::wrong_separation, std::move(message)};
  };
  if (!(d >= 0 && d <= std::numeric_limits<double>::max()))
    return wrong("the separation is negative or not finite");
  if (d == 0) return std::nullopt;
  if (options.culling != Culling::bvh && options.culling != Culling::none)
    return wrong(std::string("culling ") + name_of(options.culling) +
                 " supports no separation; use `bvh` or `none`");
  if (options.arithmetic != Arithmetic::exact)
    return wrong(std::string("arithmetic ") + name_of(options.arithmetic) +
                 " supports no separation; use `exact`");
  return std::nullopt;
}

// Returns the positions after this share of the way. Each lies between both ends, so a vertex at
// rest keeps its place.
Positions partial_step(const PositionsView& x_t0, const PositionsView& x_t1, double share) {
  Positions x(x_t0.rows(), 3);
  for (Eigen::Index v = 0; v < x_t0.rows(); ++v) {
    for (Eigen::Index k = 0; k < 3; ++k) x(v, k) = place_between(x_t0(v, k), x_t1(v, k), share);
  }
  return x;
}

// Chooses the places that limit() tries, as parts of the time until the contact. Where the way
// passes something closely, rounding decides whether a place is free. Often no place beyond a
// certain one is free; sometimes it is chance at each place. So places are tried ever farther below
// the first, until one is free; then places above that one are tried.
class PartsToTry {
 public:
  static constexpr double farthest = 0.95, enough = 0.98 * farthest;

  bool is_over() const { return free_ >= enough || tried_ == most_; }
  double next() {
    // Golden sections are spread evenly, however many are tried.
    constexpr double golden = 0.6180339887498949;
    if (free_ == 0 && tried_ < std::size(downward_)) {
      part_ = downward_[tried_];
    } else if (free_ < near_ * blocked_) {
      part_ = (free_ + blocked_) / 2;
    } else {
      spread_ = std::fmod(spread_ + golden, 1);
      part_ = free_ + (farthest - free_) * spread_;
    }
    ++tried_;
    return part_;
  }
  // Notes whether the place that was tried last is free.
  void note(bool is_free) {
    if (is_free) {
      free_ = part_;
    } else {
      blocked_ = std::min(blocked_, part_);
    }
  }

 private:
  static constexpr double near_ = 0.98;
  static constexpr double downward_[] = {farthest, 0.946, 0.941, 0.936, enough, 0.92, 0.91, 0.88,
                                         0.85,     0.8,   0.7,   0.6,   0.4,    0.2,  0.05};
  static constexpr std::size_t most_ = 19;

  double part_ = 0, free_ = 0, blocked_ = 1, spread_ = 0;
  std::size_t tried_ = 0;
};

}  // namespace

SavedState::SavedState(StateFields fields)
    : fields_(std::make_shared<const StateFields>(std::move(fields))) {}

bool operator==(const SavedState& a, const SavedState& b) { return a.fields() == b.fields(); }

struct Detector::Parts {
  StepContext context;
  std::optional<StepState> committed, evaluated;

  StepResult answer(const SteppedMesh& step, const StepQuestion& question,
                    std::span<const ViewPrimitive> primitives, const StopFunction& stop) {
    evaluated.reset();
    return evaluate_step(context, committed, step, question, primitives, stop, evaluated);
  }
};

Detector::Detector(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;
Detector::~Detector() = default;

Expected<Detector> Detector::create(const TrianglesView& triangles, const PositionsView& positions,
                                    const Options& options) {
  return create(triangles, positions, options, never_stops);
}

Expected<Detector> Detector::create(const TrianglesView& triangles, const PositionsView& positions,
                                    const Options& options, const StopFunction& stop) {
  const ProcessorState state;
  return assemble(triangles, positions, options, standard_stages(options),
                  state.in_callers_state(stop));
}

Expected<Detector> assemble(const TrianglesView& triangles, const PositionsView& positions,
                            const Options& options, Stages stages, const StopFunction& stop) {
  return assemble(triangles, positions, options, std::move(stages), stop, Workers(options.threads));
}

Expected<Detector> assemble(const TrianglesView& triangles, const PositionsView& positions,
                            const Options& options, Stages stages, const StopFunction& stop,
                            Workers workers) {
  const ProcessorState state;
  if (auto problem = check_separation(options)) return std::move(*problem);
  const StopFunction callers = state.in_callers_state(stop);
  SharedStop shared(callers);
  const StopFunction shared_stop = shared.function();
  PacedStop pace(shared_stop, workers);
  if (auto problem = check_corners(triangles, positions.rows())) return std::move(*problem);
  auto problem = check_positions(positions, positions.rows());
  if (!problem && options.counted)
    problem = check_counted_pairs(*options.counted, triangles, positions.rows());
  if (problem) {
    auto before = check_repeated(triangles, positions.rows(), pace);
    return std::move(before ? *before : *problem);
  }
  const auto stopped = [] {
    return Problem{InputError::stopped, "stopped while the detector was created"};
  };
  if (pace.now()) return stopped();
  Surface surface = uses_views(options.culling)
                        ? stages.boundary->close_up(triangles, positions.rows(), pace)
                        : surface_without_ghosts(triangles, positions.rows(), pace);
  if (pace.now()) return stopped();
  // For most meshes the edges alone show that no triangle is repeated.
  if (surface.mesh.may_repeat_triangles) {
    if (auto repeated = check_repeated(triangles, positions.rows(), pace))
      return std::move(*repeated);
  }
  BoundingVolumeTree tree(surface.mesh, positions, &pace);
  if (pace.now()) return stopped();
  // If times are not unique, the pairs found would depend on the kept pairs.
  const bool keeps_near = options.keeps_near && options.arithmetic == Arithmetic::exact;
  // Kept feature pairs need a margin (L20).
  tree.grow_boxes(
      std::max(stages.elementary->separation(), keeps_near ? FloatGrid::least_distance : 0));
  SearchMemory search(tree);
  auto mesh_search = stages.pair_search->prepare(surface.mesh, tree, pace);
  if (pace.now()) return stopped();
  StepContext context{options,
                      std::move(stages),
                      std::move(surface),
                      std::move(tree),
                      std::move(search),
                      std::move(mesh_search),
                      uses_views(options.culling) ? FirstViews(positions) : FirstViews(),
                      {},
                      std::move(workers),
                      {}};
  context.relation = PairRelation(options.counted, context.surface.mesh);
  context.options.keeps_near = keeps_near;
  context.options.counted = nullptr;  // it belongs to the user, who may free it
  return Detector(
      std::unique_ptr<Detector::Parts>(new Detector::Parts{std::move(context), {}, {}}));
}

StepResult Detector::evaluate(const PositionsView& x_t0, const PositionsView& x_t1,
                              std::span<const ViewPrimitive> primitives, const StopFunction& stop) {
  const ProcessorState state;
  return parts_->answer({x_t0, x_t1}, {parts_->context.options.pairs}, primitives,
                        state.in_callers_state(stop));
}

StepResult Detector::first_contact(const PositionsView& x_t0, const PositionsView& x_t1,
                                   double until, const StopFunction& stop) {
  const ProcessorState state;
  if (until >= 0 && until <= 1)
    return parts_->answer({x_t0, x_t1}, {Pairs::first, until}, {}, state.in_callers_state(stop));
  parts_->evaluated.reset();
  StepResult refused;
  refused.problem = {InputError::wrong_bound, "`until` is not a time from 0 to 1"};
  return refused;
}

std::optional<Problem> Detector::commit() {
  if (!parts_->evaluated) {
    return Problem{InputError::nothing_to_commit, "there is no evaluated step to commit"};
  }
  parts_->committed = std::move(parts_->evaluated);
  parts_->evaluated.reset();
  return std::nullopt;
}

StepResult Detector::step(const PositionsView& x_t0, const PositionsView& x_t1,
                          std::span<const ViewPrimitive> primitives, const StopFunction& stop) {
  StepResult result = evaluate(x_t0, x_t1, primitives, stop);
  if (parts_->evaluated) commit();
  return result;
}

StepLimit Detector::limit(const PositionsView& x_t0, const PositionsView& x_t1,
                          const StopFunction& callers) {
  const ProcessorState state;
  const StopFunction stop = state.in_callers_state(callers);
  StepLimit limit;
  limit.positions = x_t0;
  const Arithmetic arithmetic = parts_->context.options.arithmetic;
  if (arithmetic != Arithmetic::exact && arithmetic != Arithmetic::bounded) {
    parts_->evaluated.reset();
    limit.problem = {InputError::proves_nothing, std::string("arithmetic ") + name_of(arithmetic) +
                                                     " proves no step free; use exact or bounded"};
    return limit;
  }
  // Only the first contact decides where the way ends, and only a free step is committed.
  StepResult whole = first_contact(x_t0, x_t1, 1, stop);
  limit.answer = whole.answer;
  limit.problem = std::move(whole.problem);
  limit.first = whole.first;
  if (whole.answer == Answer::free) {
    limit.share = 1;
    limit.positions = x_t1;
  }
  if (whole.answer != Answer::collision) return limit;
  parts_->evaluated.reset();
  PartsToTry parts;
  std::optional<StepState> reached;
  while (whole.first.hi > 0 && !parts.is_over()) {
    const double share = parts.next() * whole.first.lo;
    Positions x = partial_step(x_t0, x_t1, share);
    bool is_free = x == x_t0;
    // Near the least double, a part of the time may be rounded up to the time itself.
    if (!is_free && share < whole.first.lo) {
      const Answer answer = first_contact(x_t0, x, 1, stop).answer;
      is_free = answer == Answer::free;
      if (!is_free && answer != Answer::collision) {
        limit.answer = answer;  // stopped
        limit.share = 0;
        limit.positions = x_t0;
        return limit;
      }
      if (is_free) {
        limit.share = share;
        limit.positions = std::move(x);
        reached = std::move(parts_->evaluated);
      }
    }
    parts.note(is_free);
  }
  limit.is_short =
      whole.first.hi > 0 && (limit.share == 0 || limit.share < PartsToTry::enough * whole.first.lo);
  parts_->evaluated = std::move(reached);
  return limit;
}

void Detector::reset() {
  parts_->committed.reset();
  parts_->evaluated.reset();
  parts_->context.search.near.forget();
}

SavedState Detector::state() const {
  const ProcessorState processor;
  StepContext& context = parts_->context;
  PacedStop pace(never_stops, context.workers);
  context.views.make(context, pace, std::numeric_limits<double>::infinity());
  return SavedState(StateFields{digest_of(context), context.options.culling, parts_->committed,
                                context.views.apex_rules(), context.views.anchors(),
                                context.views.work()});
}

std::optional<Problem> Detector::restore(const SavedState& saved) {
  const ProcessorState processor;
  const StateFields& state = saved.fields();
  StepContext& context = parts_->context;
  if (state.mesh != digest_of(context)) {
    return Problem{InputError::foreign_state,
                   "the state is of another mesh, or of a detector counting pairs in other bodies"};
  }
  const bool has_views = uses_views(context.options.culling);
  const std::size_t anchors = has_views ? context.surface.mesh.components.size() : 0,
                    rules = has_views ? context.surface.loops.size() : 0;
  if (state.culling != context.options.culling || state.anchors.size() != anchors ||
      state.apex_rules.size() != rules) {
    return Problem{InputError::foreign_state, "the state is of a detector with another culling"};
  }
  if (!fits(state, context.surface, anchors)) {
    return Problem{InputError::damaged_state, "the state contradicts its mesh"};
  }
  StateFields copy = state;  // copied first, so that nothing has changed if memory fails here
  parts_->committed = std::move(copy.committed);
  context.views.replace(std::move(copy.anchors), std::move(copy.apex_rules), copy.view_work);
  parts_->evaluated.reset();
  return std::nullopt;
}

const Topology& Detector::topology() const { return parts_->context.surface.mesh; }

const Surface& Detector::surface() const {
  Surface& surface = parts_->context.surface;
  if (surface.with_ghosts.triangles.empty()) {
    PacedStop pace(never_stops, parts_->context.workers);
    add_ghosts(surface, pace);
  }
  return surface;
}

}  // namespace assay::detector
