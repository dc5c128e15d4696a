// Whether two triangles of the surface meet, mesh or ghost, feature by feature.
#pragma once

#include "detector/contact/elementary.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/surface.h"

namespace assay::detector {

class FacePairTest {
 public:
  using Corners = std::array<std::int32_t, 3>;

  // Corners are rows of the views. piercing_at_start: also edges that pierce at t=0, which features
  // that meet later do not tell.
  FacePairTest(const PositionsView& x_t0, const PositionsView& x_t1,
               const ElementaryTest& elementary, bool piercing_at_start)
      : x_t0_(x_t0), x_t1_(x_t1), elementary_(elementary), pierces_too_(piercing_at_start) {}

  // Closed faces of the two that share no vertex meet at some time of the step. Up to 15
  // elementary tests, most of them settled by axis order.
  bool meet(const Corners& a, const Corners& b, GhostCounts& counts) const;

 private:
  MovingPoint path(std::int32_t v) const { return moving_point(x_t0_, x_t1_, v); }
  bool contact(const FourPoints& query, GhostCounts& counts) const;
  bool pierces(const Corners& edges_of, const Corners& face) const;

  PositionsView x_t0_, x_t1_;
  const ElementaryTest& elementary_;
  bool pierces_too_;
};

}  // namespace assay::detector
