// What triangles in doubt touch at the start of a step that goes on from a committed one (L9).
//
// Only these are looked at, and only against what the step before has left: that is enough.
//   Mesh against mesh: a pair that meets at the end of a step was in contact during it, so it is in
//   that step's complete pair set (L7). One that pierces there without any feature contact pierced
//   at its start too, where both were dirty, and was tested for that.
//   Mesh against ghosts: a triangle that a ghost meets at the end was touched during the step, or
//   is pierced since before it and was dirty then (L11). Either way it is in doubt.
// What is clean touches nothing (L8).
#pragma once

#include <span>

#include "detector/step/step_work.h"

namespace assay::detector {

// Sets touched[t] for the triangles of the pairs in work.known->met that still meet at t=0. False
// when stopped. 15 elementary tests a pair at most.
bool add_lasting_contacts(StepWork& work, std::vector<std::uint8_t>& touched);

// Sets touched[t] for those triangles in doubt of component c that a ghost of it meets or pierces
// at t=0. False when stopped. A descent of the tree of each hole for a triangle. `grid`: of
// work.x_t0, made once for all components, for it looks at each vertex of the mesh.
bool add_ghost_touches(StepWork& work, const FloatGrid& grid, std::size_t c,
                       std::span<const std::int32_t> in_doubt, std::vector<std::uint8_t>& touched);

}  // namespace assay::detector
