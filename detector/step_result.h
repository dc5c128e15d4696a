// What a step reports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "detector/mesh/problem.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// Bits of StepResult::doubts.
namespace doubt {
inline constexpr std::uint8_t violated = 1, dirty = 2;
}

// Whether a step was made with views, and why not. A step without them tests every pair that its
// boxes do not tell apart, so this is a matter of cost alone.
enum class ViewUse : std::uint8_t {
  used,
  not_asked_for,      // by the culling, or the step was refused or stopped before
  resting,            // views have not paid in the steps before
  start_unknown,      // too little of it is seen to be clean; the next step knows more (L15)
  hopeless,           // of a few triangles, doubles can tell too few signs
  saving_too_little,  // of one sign are too few triangles
  among_ghosts,       // too many triangles are near ghosts
  among_dirty,        // too few triangles are clean
};

struct StepResult {
  Answer answer = Answer::error;
  std::optional<Problem> problem;  // when answer is error
  // When answer is collision: exact, the enclosure of the first contact time; bounded, an interval
  // that holds it if there is a contact at all; double and float, a time without promise.
  TimeEnclosure first;
  std::vector<PairContact> pairs;  // ascending by pair, each with its first time

  // Sizes of V+, V-, V0 without Vv, and of Vv: disjoint, together all triangles. A step without
  // views (culling normal_cone, bvh and none, and view-auto where it falls back to bvh) has no view
  // sets: all are 0; doubts, signs, primitives and apexes are empty.
  std::size_t view_positive = 0, view_negative = 0, view_zero = 0;
  std::size_t against_all = 0;  // Vv: violated, dirty, or both
  std::size_t violated = 0;     // touched by a ghost during the step
  std::size_t dirty = 0;        // carry doubt into this step
  ViewUse views = ViewUse::not_asked_for;

  // By triangle of the mesh: doubt::violated, doubt::dirty.
  std::vector<std::uint8_t> doubts;
  // Sign over the step of each triangle of the mesh, then of each ghost.
  std::vector<ViewSign> signs;
  std::vector<ViewPrimitive> primitives;  // one for each component
  std::vector<MovingPoint> apexes;        // one for each loop, see Detector::surface()

  StepCounts counts;
  StepTimes times;
};

}  // namespace assay::detector
