// Finds which triangles of a component are clean at an instant (L9). It goes piece by piece; the
// triangles of a piece have one layer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/surface.h"

namespace assay::detector {

// The surface at an instant. `x` has the vertices of the mesh, then the apexes. touched[t], by
// triangle of the mesh, is 1 if t meets another triangle or a ghost of its component beyond what
// they share.
struct TouchedSurface {
  const Surface& surface;
  PositionsView x;
  const std::vector<std::uint8_t>& touched;
  Arithmetic arithmetic = Arithmetic::exact;
  PacedStop* pace = nullptr;  // if it was stopped, clean[] must not be used
};

// Returns a few clean triangles of the mesh's component `c`, ascending. Any one of them tells the
// common layer of all clean triangles. Several are returned because doubles may fail at one and not
// at the next. None is returned only if no triangle of the component is clean.
std::vector<std::int32_t> layer_witnesses(const Topology& mesh, std::size_t c,
                                          const std::vector<std::uint8_t>& clean);

// Sets clean[t] for those triangles of `in_doubt` that L9 releases. REQUIRES that these are
// triangles of the mesh's component `c`, ascending, none of them clean, and that the clean
// triangles of the component touch nothing and share a layer.
//
// Two untouched triangles are linked if an edge is theirs alone (they pass it in opposite
// directions, because mesh and ghosts form a cycle). Layers continue across links; the classes are
// the pieces. A flood along links finds them. A piece that holds a clean triangle is released. For
// any other piece one exact winding number is counted (in bounded arithmetic a piece whose number
// doubles cannot tell stays dirty). It is released if its layer is the common one: that of
// `witnesses` or, if there are none, the layer with most untouched triangles (tie: the one that
// holds the lowest triangle index). It would not be enough that a piece is connected: two
// tetrahedra, one inside the other, may share an edge (case L9_shared_edge_two_layers).
//
// `is_seen` is working memory by triangle of the mesh, 0 for triangles of the component. The cost
// is that of the triangles in doubt and, if some piece holds no clean triangle, a few passes over
// the component for the winding numbers of all such pieces together. Returns the number of these
// winding numbers.
std::uint64_t release_pieces(const TouchedSurface& at_instant, std::size_t c,
                             std::span<const std::int32_t> in_doubt,
                             const std::vector<std::int32_t>& witnesses,
                             std::vector<std::uint8_t>& is_seen, std::vector<std::uint8_t>& clean);

// Does the same at a new start, where all triangles of the component are in doubt.
std::uint64_t mark_clean_by_layers(const TouchedSurface& at_instant, std::size_t c,
                                   std::vector<std::uint8_t>& is_seen,
                                   std::vector<std::uint8_t>& clean);

}  // namespace assay::detector
