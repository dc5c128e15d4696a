// Whether two triangles of the surface, of the mesh or ghosts, meet, tested feature by feature.
#pragma once

#include "detector/contact/elementary.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/surface.h"

namespace assay::detector {

class FacePairTest {
 public:
  using Corners = std::array<std::int32_t, 3>;

  // Corners are rows of the views. With piercing_at_start two triangles also meet if an edge of
  // one pierces the other at t=0. No features need meet during the step for that, so it has a test
  // of its own.
  FacePairTest(const SteppedMesh& motion, const ElementaryTest& elementary, bool piercing_at_start)
      : motion_(motion), elementary_(elementary), pierces_too_(piercing_at_start) {}

  // Whether closed faces of the two (vertices, edges, triangles) that share no vertex meet at some
  // time of the step. Makes up to 15 elementary tests, most of which are settled by axis order.
  bool meet(const Corners& a, const Corners& b, GhostCounts& counts) const;

 private:
  MovingPoint path(std::int32_t v) const { return motion_.path(v); }
  bool contact(const FourPoints& query, GhostCounts& counts) const;
  bool pierces(const Corners& edges_of, const Corners& face) const;

  SteppedMesh motion_;
  const ElementaryTest& elementary_;
  bool pierces_too_;
};

}  // namespace assay::detector
