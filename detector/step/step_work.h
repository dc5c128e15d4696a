// What the stages of one step read and write.
#pragma once

#include <algorithm>

#include "detector/boundary/boundary_handler.h"
#include "detector/mesh/paced_stop.h"
#include "detector/options.h"
#include "detector/parallel/workers.h"
#include "detector/state/step_state.h"

namespace assay::detector {

struct StepWork {
  const Surface& surface;
  BoundingVolumeTree& tree;  // of the mesh; whoever searches refits it first
  const BoundaryHandler& boundary;
  const ElementaryTest& elementary;
  const StopFunction& stop;  // all workers may ask it
  const Workers& workers;
  PositionsView x_t0, x_t1;  // rows: vertices of the mesh, then apexes
  const StepState* known;    // the state of the last commit, where the step starts there; or null

  std::vector<ViewPrimitive> primitives = {};  // by component
  std::vector<ViewSign> signs = {};            // by triangle of the surface
  std::vector<std::uint8_t> free = {};         // by component: by L5, over the whole step
  std::vector<std::uint8_t> clean = {};        // by triangle of the mesh, at t=0
  std::vector<std::uint8_t> touched = {};      // by triangle of the mesh: by a ghost, in the step
  std::vector<std::uint8_t> near_ghosts = {};  // the same by moving boxes; for the counts
  StepCounts counts = {};
  // Of what is done for one component after another: a component alone may be too small to ask.
  mutable PacedStop pace = PacedStop(stop, workers);

  // Whether nothing but K and its closure is tested. Else every pair is.
  bool has_views() const { return !signs.empty(); }

  bool all_free() const {
    return std::all_of(free.begin(), free.end(), [](std::uint8_t is_free) { return is_free != 0; });
  }
  // The component with its ghosts: a cycle.
  const Component& component(std::size_t c) const { return surface.all().components[c]; }
  // Its own triangles, without its ghosts.
  std::span<const std::int32_t> own_triangles(std::size_t c) const {
    return surface.mesh.components[c].triangles;
  }
  std::span<const std::int32_t> ghosts(std::size_t c) const {
    return std::span(component(c).triangles).subspan(own_triangles(c).size());
  }
};

}  // namespace assay::detector
