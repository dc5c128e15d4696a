// What the triangles in doubt touch at the start of a step that goes on from a committed one (L9).
//
// Only triangles in doubt need to be looked at, because clean ones touch nothing (L8), and what
// they may touch is known from the committed step:
//   Mesh against mesh: a pair that meets at the end of a step was in contact during it, so it is
//   in that step's complete pair set (L7). If one triangle pierces the other there without any
//   contact of features, it did so at the start of that step too. Both were dirty then, and the
//   pair was tested for that.
//   Mesh against ghosts: a triangle that a ghost meets at the end was touched during the step, or
//   it was pierced since before the step and so was dirty (L11). Either way it is in doubt.
#pragma once

#include <span>

#include "detector/step/step_work.h"

namespace assay::detector {

// Sets touched[t] for the triangles of those pairs in step.known->met that still meet at t=0.
// False if stopped. Costs at most 15 elementary tests a pair.
bool add_lasting_contacts(const GivenStep& step, StepCost& cost,
                          std::vector<std::uint8_t>& touched);

// Sets touched[t] for those triangles in doubt of component c that a ghost of it meets or pierces
// at t=0. False if stopped. For each triangle it descends the tree of each hole. REQUIRES the grid
// of the mesh at rest at t=0, which the caller makes once for all components, because that takes a
// pass over all vertices.
bool add_ghost_touches(const GivenStep& step, StepCost& cost, const FloatGrid& grid, std::size_t c,
                       std::span<const std::int32_t> in_doubt, std::vector<std::uint8_t>& touched);

}  // namespace assay::detector
