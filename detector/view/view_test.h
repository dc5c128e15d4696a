// The view test of whole components: view sets V+, V-, V0 over a step.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/topology.h"
#include "detector/view/view_filter.h"
#include "detector/view/view_lanes.h"

namespace assay::detector {

struct ViewCounts {
  std::uint64_t lanes = 0, filter = 0, exact = 0;  // triangles settled by each rung

  ViewCounts& operator+=(const ViewCounts& other) {
    lanes += other.lanes;
    filter += other.filter;
    exact += other.exact;
    return *this;
  }
};

// Exact sign over the step: the filter, then integers for what it leaves open.
ViewSign view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive,
                   ViewCounts& counts);

// Exact signs over the step of the component's triangles, written to signs[triangle]: lanes first,
// then view_sign for what they leave open. Counts and signs do not depend on `set`.
void classify(const Topology& mesh, const Component& component, const PositionsView& x_t0,
              const PositionsView& x_t1, const ViewPrimitive& primitive,
              std::vector<ViewSign>& signs, ViewCounts& counts,
              InstructionSet set = best_instruction_set());

// Whether all triangles of the component are positive at one instant. Stops soon after the first
// that is not.
bool all_positive_at(const Topology& mesh, const Component& component, const PositionsView& x,
                     const Point& q0, const Point& q1);

}  // namespace assay::detector
