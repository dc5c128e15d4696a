// The data of one step that its stages read and write: input, marks and counts.
#pragma once

#include <algorithm>

#include "detector/boundary/boundary_handler.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/step_counts.h"
#include "detector/options.h"
#include "detector/parallel/workers.h"
#include "detector/search/pair_relation.h"
#include "detector/state/step_state.h"

namespace assay::detector {

// The input of a step. No stage changes it, except that the tree is working memory: each search
// fits the boxes of the tree to the motion that it searches.
struct GivenStep {
  const Surface& surface;
  BoundingVolumeTree& tree;  // of the mesh
  const BoundaryHandler& boundary;
  const ElementaryTest& elementary;
  const StopFunction& stop;     // all workers may call it
  SteppedMesh motion;           // rows: vertices of the mesh, then apexes
  const StepState* last_state;  // the state of the last commit if this step starts there, else null
  const PairRelation* relation = nullptr;  // null: every pair counts

  // Returns the component together with its ghosts, which is a cycle.
  const Component& component(std::size_t c) const { return surface.all().components[c]; }
  // Returns the component's own triangles, without its ghosts.
  std::span<const std::int32_t> own_triangles(std::size_t c) const {
    return surface.mesh.components[c].triangles;
  }
  bool has_ghosts(std::size_t c) const {
    return !surface.is_closed() && !surface.mesh.components[c].is_cycle;
  }
  // REQUIRES a step with views, because a step without views has no ghosts.
  std::span<const std::int32_t> ghosts(std::size_t c) const {
    return std::span(component(c).triangles).subspan(own_triangles(c).size());
  }
  // Returns whether contacts are looked for within the component. If pairs within the component's
  // body do not count, the component needs no views, no ghosts and no state (L19).
  bool looks_within(std::size_t c) const {
    const auto number = static_cast<std::int32_t>(c);
    return !relation || relation->components_meet(number, number);
  }
};

// What the stages of the step have found so far, by component and by triangle.
struct StepMarks {
  std::vector<ViewPrimitive> primitives = {};  // by component
  std::vector<ViewSign> signs = {};            // by triangle of the surface
  // By component: 1 if nothing is looked for within the component, because L5 shows it free over
  // the step, or because no pair within it counts.
  std::vector<std::uint8_t> free = {};
  std::vector<std::uint8_t> clean = {};  // by triangle of the mesh: 1 if clean at t=0
  // By triangle of the mesh: 1 if a ghost touches it during the step.
  std::vector<std::uint8_t> touched = {};
  // By triangle of the mesh: 1 if its moving box meets the moving box of a ghost. Used only for
  // counts.
  std::vector<std::uint8_t> near_ghosts = {};

  // Returns true if the step tests only K and its closure, false if it tests every pair.
  bool has_views() const { return !signs.empty(); }

  bool all_free() const {
    return std::all_of(free.begin(), free.end(), [](std::uint8_t is_free) { return is_free != 0; });
  }
};

// The cost of the stages so far. It has no influence on which pairs are found in contact.
struct StepCost {
  StepCounts counts = {};  // for the result, and for the culling of later steps
  // Counts the work since the last call of the stop function, over all components together, because
  // the work on one component alone can be too little for a call.
  PacedStop pace;
};

}  // namespace assay::detector
