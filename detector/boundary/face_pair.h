// Whether two triangles of the surface meet, mesh or ghost, feature by feature.
#pragma once

#include "detector/boundary/surface.h"
#include "detector/contact/elementary.h"

namespace assay::detector {

struct GhostCounts {
  std::uint64_t pairs = 0;             // ghost and triangle whose moving boxes are not apart
  std::uint64_t elementary_tests = 0;  // feature pairs of these tested beyond axis order
  // Triangles of those pairs, each once, in the step itself: what GhostTest::boxes calls violated.
  std::uint64_t near_triangles = 0;
};

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
