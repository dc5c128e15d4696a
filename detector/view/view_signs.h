// The view test: the sign of a triangle over a step, in doubles and in integers, and the view sets
// V+, V-, V0 of whole components.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "detector/exact/bernstein.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/view/view_lanes.h"

namespace assay::detector {

// The view test in doubles with proved bounds. It decides most signs, and no sign wrongly.

// Corners in the triangle's order.
using MovingTriangle = std::array<MovingPoint, 3>;

// Returns the sign over the whole step (L1, L2), or nullopt if doubles cannot tell. `zero` is
// proved too: it means that values of strictly different sign were found. 20 to 500 ns, no
// allocation.
std::optional<ViewSign> filter_view_sign(const MovingTriangle& triangle,
                                         const ViewPrimitive& primitive);

// Does the same in Number (double or float) with bounds 0. It promises nothing. Returns zero if no
// sign is decided.
template <class Number>
ViewSign plain_view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive);

// Error bounds after `depth` halvings. view_filter.cpp derives them, in units of 2^-53 times the
// scales T, G and L that it defines.
template <class Bounds = ProvedBounds>
constexpr auto view_cubic_error(int depth) {
  return static_cast<typename Bounds::Number>(24 + 6 * depth) * Bounds::unit;
}
template <class Bounds = ProvedBounds>
constexpr auto view_axial_error(int depth) {
  return static_cast<typename Bounds::Number>(8 + 2 * depth) * Bounds::unit;
}
inline constexpr int max_view_depth = 5;

// The view test in exact integers. It decides every sign that the filter does not decide.
//
// Returns the exact sign over the whole step (L1, L2), for every finite input. The middle piece of
// a view-line whose ends move apart is a quintic. 10 to 100 us; with denormals beside ordinary
// numbers 1 ms, rarely 20 ms.
ViewSign exact_view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive);

// Returns the sign of a triangle over the step. The filter comes first. If the filter does not
// decide, integers decide in exact arithmetic, and the sign is zero in bounded arithmetic, so that
// no sign is wrongly positive or negative. The arithmetics `double` and `float` give the sign as
// computed, and promise nothing.
ViewSign view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive,
                   ViewCounts& counts, Arithmetic arithmetic = Arithmetic::exact);

// Writes the signs over the step of the component's triangles to signs[triangle]. Lanes come first
// (except in `float`), then view_sign for the signs that lanes do not decide. Counts and signs do
// not depend on `set`. If `pace` has workers, they share the work. Returns false if `pace` was
// stopped.
bool classify(const Topology& mesh, const Component& component, const SteppedMesh& motion,
              const ViewPrimitive& primitive, std::vector<ViewSign>& signs, ViewCounts& counts,
              InstructionSet set = best_instruction_set(),
              Arithmetic arithmetic = Arithmetic::exact, PacedStop* pace = nullptr);

// Returns whether all triangles of the component are positive at one instant, seen from the segment
// q0 q1. It returns soon after the first triangle that is not positive. It also returns false if
// `pace` was stopped. In bounded arithmetic `true` is certain, and `false` may mean that doubles
// cannot tell.
bool all_positive_at(const Topology& mesh, const Component& component, const PositionsView& x,
                     const Point& q0, const Point& q1, Arithmetic arithmetic = Arithmetic::exact,
                     PacedStop* pace = nullptr);

// The view test as a stage of the detector: the signs of triangles over a step.
class ViewClassifier {
 public:
  explicit ViewClassifier(Arithmetic arithmetic = Arithmetic::exact) : arithmetic_(arithmetic) {}
  virtual ~ViewClassifier() = default;
  // Writes the signs over the step (L1, L2) of the triangles of a component of `surface`, ghosts
  // included, to signs[triangle]. REQUIRES of overriding functions that they call no triangle
  // positive or negative wrongly. They may call a triangle zero wrongly, which only costs time.
  // Returns false if `pace` was stopped; then the signs must not be used.
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
// is computed from the box around the component's vertices. The bounds are in units of 2^-53 times
// the scale T of view_bounds.cpp.
inline constexpr double lane_cubic_units = 64, lane_value_units = 112;

// Sets all members of `input` except `corners`, for triangles whose corners are among `vertices`.
// Returns false if the coordinates are out of the range in which the bounds hold. It reads each
// vertex once. If `pace` has workers, they share the work.
bool make_lane_input(std::span<const std::int32_t> vertices, const SteppedMesh& motion,
                     const ViewPrimitive& primitive, LaneInput& input, PacedStop* pace = nullptr);

}  // namespace assay::detector
