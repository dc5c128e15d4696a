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
  SteppedMesh motion;      // rows: vertices of the mesh, then apexes
  const StepState* known;  // the state of the last commit if this step starts there, else null

  std::vector<ViewPrimitive> primitives = {};  // by component
  std::vector<ViewSign> signs = {};            // by triangle of the surface
  std::vector<std::uint8_t> free = {};         // by component: 1 if L5 shows it free over the step
  std::vector<std::uint8_t> clean = {};        // by triangle of the mesh: 1 if clean at t=0
  // By triangle of the mesh: 1 if a ghost touches it during the step.
  std::vector<std::uint8_t> touched = {};
  // The same for touches of moving boxes; it serves the counts alone.
  std::vector<std::uint8_t> near_ghosts = {};
  StepCounts counts = {};
  // Asks the stop function while components are handled one after another, because the work on one
  // component alone may be too little to ask after.
  mutable PacedStop pace = PacedStop(stop, workers);

  // True: the step tests K and its closure alone. False: it tests every pair.
  bool has_views() const { return !signs.empty(); }

  bool all_free() const {
    return std::all_of(free.begin(), free.end(), [](std::uint8_t is_free) { return is_free != 0; });
  }
  // The component together with its ghosts, which is a cycle.
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
