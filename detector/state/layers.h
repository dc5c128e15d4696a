// L9: which triangles of a component are clean at an instant, without history.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/arithmetic.h"
#include "detector/boundary/surface.h"

namespace assay::detector {

// Marks clean[t] for the triangles of the mesh's component `c`. `touched[t]` (by mesh triangle)
// says that t meets another triangle or a ghost of the component, beyond what they share, at x
// (rows: vertices of the mesh, then apexes).
//
// Two untouched triangles are linked when they alone share an edge (oppositely directed, as mesh
// and ghosts form a cycle); layers continue across links, so one exact winding number serves a
// whole piece (in bounded arithmetic a piece whose number doubles cannot tell stays dirty). Clean
// are the pieces of the common layer: the layer with most untouched triangles (tie: the one that
// holds the lowest triangle index). "Connected" would not be enough: two tetrahedra, one inside the
// other, may share an edge (case L9_shared_edge_two_layers). `seen` is scratch by mesh triangle, 0
// for those of the component. O(component) for each piece.
void mark_clean_by_layers(const Surface& surface, std::size_t c, const PositionsView& x,
                          const std::vector<std::uint8_t>& touched, std::vector<std::uint8_t>& seen,
                          std::vector<std::uint8_t>& clean,
                          Arithmetic arithmetic = Arithmetic::exact);

}  // namespace assay::detector
