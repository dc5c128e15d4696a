// The result of a step. If Options::separation is above 0, "in contact" means here that two
// triangles come within that distance. The answer tells which other fields are set:
//
//   if (result.answer == Answer::error) report(result.problem->message);
//   if (result.answer == Answer::collision) use(result.first.lo, result.first.hi);
//   for (const PairContact& contact : result.pairs) use(contact.pair.a, contact.pair.b);
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "detector/mesh/problem.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// Bits of StepResult::doubts; a triangle may have both.
namespace doubt {
inline constexpr std::uint8_t violated = 1, dirty = 2;
}

// Whether a step used views, and if not, why. This affects only the cost of the step, because a
// step without views tests every pair whose boxes meet.
enum class ViewUse : std::uint8_t {
  used,
  not_asked_for,      // the culling has no views, or the step was refused or stopped too early
  resting,            // views have not paid in earlier steps
  start_unknown,      // too few triangles are known to be clean at a new start (L15)
  hopeless,           // doubles can tell too few signs in a sample of triangles
  saving_too_little,  // too few triangles are of one sign
  among_ghosts,       // too many triangles are near ghosts
  among_dirty,        // too few triangles are clean
  saving_up,          // earlier steps have not saved the cost of views (step/culling_policy.h)
};
// In texts these names follow the words "no views, ".
constexpr auto names_of(ViewUse) {
  using enum ViewUse;
  return std::to_array<Named<ViewUse>>(
      {{used, "used"},
       {not_asked_for, "the culling has no views"},
       {resting, "views have not paid in earlier steps"},
       {start_unknown, "too few triangles are known to be clean at the start"},
       {hopeless, "doubles can tell too few signs in a sample of triangles"},
       {saving_too_little, "too few triangles have the same sign"},
       {among_ghosts, "too many triangles are near ghosts"},
       {among_dirty, "too few triangles are clean"},
       {saving_up, "earlier steps saved too little to pay for views"}});
}

struct StepResult {
  Answer answer = Answer::error;
  std::optional<Problem> problem;  // when answer is error
  // The first contact time, set when answer is collision. In exact arithmetic this is the unique
  // enclosure of the time. In bounded arithmetic it is an interval that contains the time if there
  // is a contact at all. The arithmetics double and float promise nothing about it.
  TimeEnclosure first;
  std::vector<PairContact> pairs;  // ascending by pair, each with its first time

  // Sizes of the view sets. V+, V- and V0 count only triangles outside Vv, so the four sets are
  // disjoint and make up the mesh. A step without views has no view sets: all sizes are 0, and
  // doubts, signs, primitives and apexes are empty. The cullings normal_cone, bvh and none have no
  // views; in a step of automatic or view_auto, ViewUse says whether it has views.
  std::size_t view_positive = 0, view_negative = 0, view_zero = 0;
  std::size_t against_all = 0;  // Vv: violated, dirty, or both
  std::size_t violated = 0;     // touched by a ghost during the step
  std::size_t dirty = 0;        // not known to be clean at t=0
  ViewUse views = ViewUse::not_asked_for;

  std::vector<std::uint8_t> doubts;  // by triangle of the mesh: bits of namespace doubt
  // The sign over the step of each triangle of the mesh, then of each ghost.
  std::vector<ViewSign> signs;
  std::vector<ViewPrimitive> primitives;  // one for each component
  std::vector<MovingPoint> apexes;        // one for each of Surface::loops (Detector::surface)

  StepCounts counts;
  StepTimes times;
};

// How far a caller may go in a step (L17).
struct StepLimit {
  // `free`: the caller may go to the end of the step. `collision`: the caller may go to
  // `positions`. `undecided` (the stop function ended the call) and `error`: the caller may not
  // move.
  Answer answer = Answer::error;
  std::optional<Problem> problem;  // when answer is error
  // The time up to which the step is taken: 1 if the step is free, else less than the first contact
  // time.
  double share = 0;
  // Where the caller may go: x_t1 in every bit if the step is free, else x_t0 + share (x_t1 -
  // x_t0), rounded. The straight way from x_t0 to this place is free. If share is 0, it is x_t0.
  Positions positions;
  TimeEnclosure first;  // the first contact time of the whole step, when answer is collision
  // Whether the share is below 0.93 of the time `first`, although the mesh starts without a
  // contact. This means that each farther place that was tried has, once rounded, a contact on the
  // way; a farther place that was not tried can be free.
  bool is_short = false;
};

}  // namespace assay::detector
