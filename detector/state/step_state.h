// What the detector knows of its mesh between steps (L8).
#pragma once

#include <optional>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/state/policy_state.h"

namespace assay::detector {

struct StepState {
  // The end of the step. The rest holds at these positions alone, compared in every bit.
  Positions positions;
  // By triangle: 1 if it is clean by L8, that is, clean when the step began, in no contact with
  // its own component and touched by no ghost during it. The others may be released by the next
  // step (L9). After a step without views no triangle of a component with ghosts is clean, because
  // nobody swept the ghosts (L15).
  std::vector<std::uint8_t> clean;
  // The pairs in contact during the step whose triangles are of one component. met_is_complete
  // says whether these are all such pairs; they are not after a collision found by K alone.
  std::vector<TrianglePair> met;
  bool met_is_complete = true;
  // By component: its view primitive at these positions, if the winding number there is known to
  // be 1. The number stays 1 while all triangles stay positive, so L5 need not count it again.
  std::vector<std::optional<std::array<Point, 2>>> inside;

  // Evaluations leave the next member as it was when the last step was committed.
  PolicyState policy;

  // `keep` makes `x` the positions; `holds_at` says whether `x` equals them in every bit. The
  // workers of the pace share the work; it is not asked to stop.
  void keep(const PositionsView& x, const PacedStop& pace = PacedStop(never_stops));
  bool holds_at(const PositionsView& x, const PacedStop& pace = PacedStop(never_stops)) const;
};

}  // namespace assay::detector
