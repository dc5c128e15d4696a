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
  Positions positions;  // at which the rest holds, in every bit
  // By triangle, by L8 alone: clean when the step began, in no contact with its own component and
  // touched by no ghost. The next step releases (L9), when it is not free without. After a step
  // without views no triangle of a component with ghosts is clean: nobody swept them (L15).
  std::vector<std::uint8_t> clean;
  // The pairs of one component in contact during the step, and whether that is all there were
  // (after a collision found by K alone it is not).
  std::vector<TrianglePair> met;
  bool met_is_complete = true;
  // By component: its view primitive at these positions, when that is known to have winding number
  // 1 there. It keeps it while all triangles stay positive, so L5 need not count again.
  std::vector<std::optional<std::array<Point, 2>>> inside;

  // From evaluation to evaluation this stays as it was committed.
  PolicyState policy;

  // By the workers of the pace, which is not asked to stop.
  void keep(const PositionsView& x, const PacedStop& pace = PacedStop(never_stops));
  bool holds_at(const PositionsView& x, const PacedStop& pace = PacedStop(never_stops)) const;
};

}  // namespace assay::detector
