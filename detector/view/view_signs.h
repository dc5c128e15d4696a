// The view test of whole components: view sets V+, V-, V0 over a step.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/arithmetic.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/view/view_filter.h"
#include "detector/view/view_lanes.h"

namespace assay::detector {

// Sign over the step: the filter, then, for what it leaves open, integers (exact) or zero (bounded:
// never wrongly positive or negative). double, float: as computed, without promise.
ViewSign view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive,
                   ViewCounts& counts, Arithmetic arithmetic = Arithmetic::exact);

// Signs over the step of the component's triangles, written to signs[triangle]: lanes first (none
// in float), then view_sign for what they leave open. Counts and signs do not depend on `set`. By
// the workers of `pace` where it has some; false when it was stopped.
bool classify(const Topology& mesh, const Component& component, const PositionsView& x_t0,
              const PositionsView& x_t1, const ViewPrimitive& primitive,
              std::vector<ViewSign>& signs, ViewCounts& counts,
              InstructionSet set = best_instruction_set(),
              Arithmetic arithmetic = Arithmetic::exact, PacedStop* pace = nullptr);

// Whether all triangles of the component are positive at one instant. Stops soon after the first
// that is not; also false once `pace` says to end. Bounded arithmetic says so only where it is
// certain.
bool all_positive_at(const Topology& mesh, const Component& component, const PositionsView& x,
                     const Point& q0, const Point& q1, Arithmetic arithmetic = Arithmetic::exact,
                     PacedStop* pace = nullptr);

}  // namespace assay::detector
