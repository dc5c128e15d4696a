// The view test of whole components: view sets V+, V-, V0 over a step.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/view/view_filter.h"
#include "detector/view/view_lanes.h"

namespace assay::detector {

// The view test in exact integers. It decides what the filter leaves open.
//
// The exact sign over the whole step (L1, L2), for every finite input. The middle piece of a
// view-line whose ends move apart is a quintic. 10 to 100 us; if denormals stand beside ordinary
// numbers 1 ms, rarely 20 ms.
ViewSign exact_view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive);

// The sign of a triangle over the step. The filter comes first. What it leaves open is decided by
// integers in exact arithmetic, and is zero in bounded arithmetic, so that it is never wrongly
// positive or negative. In double and float the sign is as computed, and nothing is promised.
ViewSign view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive,
                   ViewCounts& counts, Arithmetic arithmetic = Arithmetic::exact);

// Writes the signs over the step of the component's triangles to signs[triangle]. Lanes come first
// (except in float), then view_sign for what they leave open. Counts and signs do not depend on
// `set`. The workers of `pace` share the work if it has some. False if it was stopped.
bool classify(const Topology& mesh, const Component& component, const SteppedMesh& motion,
              const ViewPrimitive& primitive, std::vector<ViewSign>& signs, ViewCounts& counts,
              InstructionSet set = best_instruction_set(),
              Arithmetic arithmetic = Arithmetic::exact, PacedStop* pace = nullptr);

// Whether all triangles of the component are positive at one instant, seen from the segment q0 q1.
// It ends soon after the first triangle that is not. Also false once `pace` says to end. In
// bounded arithmetic true is certain, and false may mean that doubles cannot tell.
bool all_positive_at(const Topology& mesh, const Component& component, const PositionsView& x,
                     const Point& q0, const Point& q1, Arithmetic arithmetic = Arithmetic::exact,
                     PacedStop* pace = nullptr);

// The view test as a stage of the detector: the signs of triangles over a step.
class ViewClassifier {
 public:
  explicit ViewClassifier(Arithmetic arithmetic = Arithmetic::exact) : arithmetic_(arithmetic) {}
  virtual ~ViewClassifier() = default;
  // Writes the signs over the step (L1, L2) of the triangles of a component of `surface`, ghosts
  // included, to signs[triangle]. REQUIRES of overriding functions that no triangle is wrongly
  // called positive or negative. It may be wrongly called zero, which only costs time. False if
  // stopped: then the signs are of no use.
  virtual bool classify(const Topology& surface, const Component& component,
                        const SteppedMesh& motion, const ViewPrimitive& primitive,
                        std::vector<ViewSign>& signs, ViewCounts& counts, PacedStop& pace) const {
    return detector::classify(surface, component, motion, primitive, signs, counts,
                              best_instruction_set(), arithmetic_, &pace);
  }

 private:
  Arithmetic arithmetic_;
};

// Error bounds of the view test in lanes. All triangles of a component have the same bound, which
// comes from the box around the component's vertices. In units of 2^-53 times the scales named in
// view_bounds.cpp.
inline constexpr double lane_cubic_units = 64, lane_value_units = 112;

// Fills in everything of `input` but `corners`, for triangles whose corners are among `vertices`.
// False if the coordinates are out of the range in which the bounds hold. It reads each vertex
// once, and the workers of `pace` share the work if it has some.
bool make_lane_input(std::span<const std::int32_t> vertices, const SteppedMesh& motion,
                     const ViewPrimitive& primitive, LaneInput& input, PacedStop* pace = nullptr);

}  // namespace assay::detector
