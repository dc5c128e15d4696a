// Algorithm 3 of the thesis, self-collision detection with the view-based approach. Without the
// lines for holes it is Algorithm 1. The printed excerpts of the thesis describe most lines in
// words (3.6, 4.3, 4.4) and have no listing. So (r) marks a line that is reconstructed, and + marks
// a line that is added, or that replaces the line above it, by the laws of detector/LAWS.md. The
// right column names the function that does the line, or the stage that this function calls.
// evaluate_step() moves the ghosts, and keeps the state at the end; run_stages() does everything
// else, in this order.
//
//   in preprocessing                                             assemble
//     (r) build a BVH of the mesh
//         make ghost triangles over each hole
//     +     a fan of ghosts for each boundary loop               BoundaryHandler (L11, L12)
//         compute a view primitive inside the object
//     +     one for each component, inside or outside            make_view_anchor (L10)
//     +     when views are first due                             FirstViews
//   in each step
//     (r) move the ghosts and the view primitive                 move_ghosts, place_primitives
//         divide all triangles into V+, V- and V0 by view tests  classify_components (L1, L2)
//     +     and all ghosts
//         if all triangles are in V+: self-collision free
//     +     for a component with its ghosts, winding number 1    ReleaseRule (L5)
//     +   drop views if they do not pay, and test every pair     drop_views, CullingPolicy
//     +   find the triangles that are clean at the start         find_start (L8, L9)
//     +     drop views if too few are clean                      drop_views, CullingPolicy
//         hole by hole: pairs of the BVH and the ghosts,
//           elementary tests; triangles in contact go into Vv    sweep_ghosts (L11)
//     +   if the only component is free, end the step            ends_free (L5)
//         mark the triangles whose type has changed: the vBVHs   mark_types, Marking
//     (r) refit the boxes of the BVH                             find_pairs, MeshSearch
//     +     or use the pairs kept from a longer step, no boxes   (L20)
//         traverse (V+,V-), (U,V0) and (U,Vv), passing over
//           nodes with a single child                            find_pairs, PairRule (L3)
//     +     and the pairs of two components                      (L10)
//     (r) elementary tests of the pairs found                    find_pairs, ElementaryTest
//     +   closure: (U,H) until H is stable                       close_pairs, PairRule (L7)
//         if the step is free: release Vv
//     +     Vv: the triangles that are not known to be clean     finish, ReleaseRule (L8)
#include "detector/step/step.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

#include "detector/mesh/for_all.h"
#include "detector/mesh/mesh_checks.h"
#include "detector/search/stopwatch.h"
#include "detector/step/culling_policy.h"
#include "detector/step/step_run.h"

namespace assay::detector {
namespace {

// Returns one anchor for each component: where it is seen from best, with its ghosts, at these
// positions. Where views are used only if they pay, their search has to be cheap beside a step.
std::vector<ViewAnchor> place_anchors(const Surface& surface,
                                      const std::vector<ApexRule>& apex_rules, Culling culling,
                                      const PositionsView& positions, PacedStop& pace) {
  std::vector<MovingPoint> apexes;
  for (std::size_t l = 0; l < surface.loops.size(); ++l) {
    const Point apex = place_apex(apex_rules[l], surface.loops[l], positions);
    apexes.push_back({apex, apex});
  }
  const Positions x = with_apexes(positions, apexes, false);
  std::vector<ViewAnchor> anchors;
  for (const auto& component : surface.all().components) {
    const Effort effort = effort_for(component, surface.mesh,
                                     chooses_views(culling) ? Effort::brief : Effort::thorough);
    constexpr std::uint64_t work_of_one = 20, planes = 1024;
    const std::uint64_t count = component.triangles.size();
    if (pace.after(effort == Effort::least ? 400 : work_of_one * std::min(count, planes))) break;
    if (chooses_views(culling)) {
      anchors.push_back(
          choose_view_anchor(surface.all(), component, surface.first_apex, x, effort, &pace));
    } else {
      const ViewKind kind = culling == Culling::view_line ? ViewKind::line : ViewKind::point;
      anchors.push_back(
          make_view_anchor(kind, surface.all(), component, surface.first_apex, x, effort, &pace));
    }
  }
  return anchors;
}

// Returns whether check_positions would find no problem. The workers share the rows, because no row
// has to be named here.
bool is_whole(const PositionsView& x, Eigen::Index vertex_count, const PacedStop& pace) {
  if (x.rows() != vertex_count) return false;
  std::atomic<bool> found_nothing = true;
  PacedStop unasked = pace.unasked();
  for_all_pieces(static_cast<std::size_t>(x.rows()), least_shared, 0, &unasked,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   const auto first = static_cast<Eigen::Index>(begin),
                              count = static_cast<Eigen::Index>(end - begin);
                   if (check_positions(x.middleRows(first, count), count)) found_nothing = false;
                 });
  return found_nothing;
}

// Checks the input of a step. Errors: wrong_frame_size, non_finite_coordinate,
// wrong_primitive_count (neither none, nor one, nor one for each component). Only the workers of
// `pace` are used; it is not asked to stop.
std::optional<Problem> check_step_input(const Surface& surface, const SteppedMesh& motion,
                                        std::span<const ViewPrimitive> primitives,
                                        PacedStop& pace) {
  for (const auto* x : {&motion.vertices_t0, &motion.vertices_t1}) {
    if (!is_whole(*x, surface.first_apex, pace)) return check_positions(*x, surface.first_apex);
    if (motion.is_at_rest()) break;
  }
  const auto components = surface.mesh.components.size();
  if (primitives.size() > 1 && primitives.size() != components) {
    return Problem{InputError::wrong_primitive_count,
                   std::to_string(primitives.size()) + " view primitives are given, not 0, 1 or " +
                       std::to_string(components) + " (one for each component)"};
  }
  for (const auto& primitive : primitives) {
    for (const auto* point :
         {&primitive.q0.t0, &primitive.q0.t1, &primitive.q1.t0, &primitive.q1.t1}) {
      if (!std::all_of(point->begin(), point->end(), [](double c) { return std::isfinite(c); })) {
        return Problem{InputError::non_finite_coordinate, "a coordinate of a view is not finite"};
      }
    }
  }
  return std::nullopt;
}

// Returns the result of a step that is stopped, or refused with this problem.
StepResult no_answer(std::optional<Problem> problem = std::nullopt) {
  StepResult result;
  result.answer = problem ? Answer::error : Answer::undecided;
  result.problem = std::move(problem);
  return result;
}

// Runs the algorithm above, in its order. Returns false if it was stopped.
bool run_stages(StepRun& step, const SteppedMesh& mesh, std::span<const ViewPrimitive> primitives) {
  if (!step.place_primitives(mesh, primitives)) return false;
  if (!step.classify_components()) return false;
  if (!step.pays_to_sweep()) step.drop_views();
  if (!step.find_start()) return false;
  if (!step.pays_to_use()) step.drop_views();
  if (!step.sweep_ghosts()) return false;
  if (step.ends_free()) return true;
  return step.mark_types() && step.find_pairs() && step.close_pairs();
}

// The policy of the culling asked for, made without allocating.
class PolicyOfStep {
 public:
  PolicyOfStep(StepContext& context, const std::optional<StepState>& state)
      : PolicyOfStep(context, state ? state->policy : PolicyState{}) {}
  CullingPolicy& policy() {
    if (model_) return *model_;
    return fixed_;
  }

 private:
  PolicyOfStep(StepContext& context, const PolicyState& before)
      : fixed_(context.options.culling, before) {
    if (!chooses_views(context.options.culling)) return;
    if (!context.adjacent_pairs) context.adjacent_pairs = adjacent_pairs(context.surface.mesh);
    model_.emplace(context.surface, *context.adjacent_pairs, before,
                   context.options.culling == Culling::automatic);
  }
  FixedPolicy fixed_;
  std::optional<CostModel> model_;
};

// The paths of the apexes, and the mesh with them: their rows follow those of the mesh.
struct MovedGhosts {
  std::vector<MovingPoint> apexes;
  Positions all_t0, all_t1;
};

// Returns false if it was stopped.
bool move_ghosts(const StepContext& context, const SteppedMesh& mesh, PacedStop& pace,
                 MovedGhosts& ghosts) {
  constexpr std::uint64_t work_of_apex = 10, work_of_vertex = 3;
  const Surface& surface = context.surface;
  ghosts.apexes = context.stages.boundary->place_apexes(surface, context.views.apex_rules(), mesh);
  if (pace.after(work_of_apex * surface.ghost_count())) return false;
  ghosts.all_t0 = with_apexes(mesh.vertices_t0, ghosts.apexes, false);
  if (pace.after(work_of_vertex * at(surface.first_apex))) return false;
  ghosts.all_t1 = with_apexes(mesh.vertices_t1, ghosts.apexes, true);
  return true;
}

}  // namespace

FirstViews::Making FirstViews::make(StepContext& context, PacedStop& pace, double most) {
  if (!x_) return work_ <= most ? Making::yes : Making::too_dear;
  if (work_ >= most) return Making::too_dear;
  const Surface& surface = context.surface;
  constexpr std::uint64_t between = ApexChoice::work_between_asks;
  // Once the stop function has asked for an end it is not asked again.
  const StopFunction stop = [&] { return pace.after(between); };
  PacedStop counted(stop, between, most);
  const StopFunction paced = [&] { return counted.after(between); };
  std::vector<ApexRule> rules;
  if (!surface.is_closed())
    rules = context.stages.boundary->choose_apexes(surface, context.tree, *x_,
                                                   *context.stages.elementary, paced);
  context.tree.forget_fit();
  std::vector<ViewAnchor> anchors;
  if (!counted.stopped())
    anchors = place_anchors(surface, rules, context.options.culling, *x_, counted);
  if (pace.stopped()) return Making::stopped;
  if (counted.stopped() || counted.spent() > most) {
    work_ = most;
    return Making::too_dear;
  }
  replace(std::move(anchors), std::move(rules), counted.spent());
  return Making::yes;
}

void FirstViews::replace(std::vector<ViewAnchor> anchors, std::vector<ApexRule> rules,
                         double work) {
  anchors_ = std::move(anchors);
  apex_rules_ = std::move(rules);
  work_ = work;
  x_.reset();
}

StepResult evaluate_step(StepContext& context, const std::optional<StepState>& state,
                         const SteppedMesh& input, const StepQuestion& question,
                         std::span<const ViewPrimitive> primitives, const StopFunction& callers,
                         std::optional<StepState>& next) {
  // From here on equal ends are one array, so later stages compute everything once.
  const bool rests = input.vertices_t0.rows() == input.vertices_t1.rows() &&
                     (input.is_at_rest() || input.vertices_t0 == input.vertices_t1);
  const SteppedMesh mesh = rests ? input.at_start() : input;
  SharedStop shared(callers);
  const StopFunction stop = shared.function();
  PacedStop pace(stop, context.workers);
  if (auto problem = check_step_input(context.surface, mesh, primitives, pace))
    return no_answer(std::move(problem));
  const bool goes_on = state && context.stages.release->still_holds(*state, mesh.vertices_t0, pace);
  PolicyOfStep policy_of_step(context, state);
  CullingPolicy& policy = policy_of_step.policy();
  double total = 0;
  StepResult result;
  {
    Stopwatch watch(total);
    MovedGhosts ghosts;
    const bool needs_views = primitives.empty() || !context.surface.is_closed();
    policy.begin(mesh, goes_on ? &*state : nullptr, needs_views);
    if (needs_views && policy.is_due()) {
      const auto making = context.views.make(context, pace, policy.most_for_views());
      if (making == FirstViews::Making::stopped) return no_answer();
      policy.pay_for_views(making == FirstViews::Making::yes, context.views.work());
    }
    const bool moves_ghosts = !context.surface.is_closed() && policy.is_due();
    if (moves_ghosts && !move_ghosts(context, mesh, pace, ghosts)) return no_answer();
    const SteppedMesh motion = moves_ghosts ? SteppedMesh{ghosts.all_t0, ghosts.all_t1} : mesh;
    StepRun step(context, goes_on ? &*state : nullptr, motion, question, policy, stop);
    const bool completed = run_stages(step, mesh, primitives);
    result = step.finish(completed, input, primitives.empty(), next);
    if (!result.primitives.empty()) result.apexes = std::move(ghosts.apexes);
  }
  result.times.total = total;
  return result;
}

}  // namespace assay::detector
