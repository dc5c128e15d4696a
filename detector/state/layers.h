// Finds which triangles of a component are clean at an instant (L9). It decides for one piece after
// another, because all triangles of a piece have the same layer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/surface.h"

namespace assay::detector {

// The surface at an instant. `x` has the vertices of the mesh, then the apexes. touched[t] is 1 if
// triangle t of the mesh meets another triangle or a ghost of its component beyond the vertices
// and edges that they share.
struct TouchedSurface {
  const Surface& surface;
  PositionsView x;
  const std::vector<std::uint8_t>& touched;
  Arithmetic arithmetic = Arithmetic::exact;
  PacedStop* pace = nullptr;  // if the pace was stopped, clean[] must not be used
};

// Returns a few clean triangles of the mesh's component `c`, ascending. The layer of any one of
// these is the common layer of all clean triangles. Several are returned because doubles may be
// able to tell the layer of one of them and not of another. The result is empty only if no triangle
// of the component is clean.
std::vector<std::int32_t> layer_witnesses(const Topology& mesh, std::size_t c,
                                          const std::vector<std::uint8_t>& clean);

// Sets clean[t] for those triangles of `in_doubt` that L9 releases. REQUIRES that `in_doubt` lists
// triangles of the mesh's component `c`, ascending, none of them clean, and that the clean
// triangles of the component touch nothing and have one common layer.
//
// Two untouched triangles are linked if they share an edge that no third triangle and no ghost has.
// (They pass this edge in opposite directions, because mesh and ghosts form a cycle.) The layer is
// the same across a link, and the pieces are the sets of triangles that links connect. A flood
// along links finds the pieces. A piece with a clean triangle is released. For any other piece one
// exact winding number is counted (in bounded arithmetic a piece whose number doubles cannot tell
// stays dirty). The piece is released if its layer is the common layer: the layer of `witnesses`
// or, if there are none, the layer with most untouched triangles (tie: the layer of the lowest
// triangle index). It is not enough that a piece is connected to a clean piece: two tetrahedra, one
// inside the other, can share an edge (case L9_shared_edge_two_layers).
//
// `is_seen` is working memory with one element for each triangle of the mesh. REQUIRES that it is 0
// for the triangles of the component. The cost is proportional to the number of triangles in doubt.
// If some piece has no clean triangle, a few passes over the component are added, for the winding
// numbers of all such pieces together. Returns the number of these winding numbers.
std::uint64_t release_pieces(const TouchedSurface& at_instant, std::size_t c,
                             std::span<const std::int32_t> in_doubt,
                             const std::vector<std::int32_t>& witnesses,
                             std::vector<std::uint8_t>& is_seen, std::vector<std::uint8_t>& clean);

// Does the same at a new start, where all triangles of the component are in doubt.
std::uint64_t mark_clean_by_layers(const TouchedSurface& at_instant, std::size_t c,
                                   std::vector<std::uint8_t>& is_seen,
                                   std::vector<std::uint8_t>& clean);

}  // namespace assay::detector
