// L9: which triangles of a component are clean at an instant, by pieces of the same layer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "detector/mesh/arithmetic.h"
#include "detector/mesh/surface.h"

namespace assay::detector {

// An instant of the surface: x has the vertices of the mesh, then apexes. `touched[t]` (by mesh
// triangle) says that t meets another triangle or a ghost of its component, beyond what they share.
struct TouchedSurface {
  const Surface& surface;
  PositionsView x;
  const std::vector<std::uint8_t>& touched;
  Arithmetic arithmetic = Arithmetic::exact;
  PacedStop* pace = nullptr;  // where it was stopped, what is said to be clean is of no use
};

// Clean triangles of the mesh's component `c`, a few of them, ascending: any one names the common
// layer of all clean ones. More than one because doubles may fail at one and not at the next. None
// only where no triangle of the component is clean.
std::vector<std::int32_t> layer_witnesses(const Topology& mesh, std::size_t c,
                                          const std::vector<std::uint8_t>& clean);

// Sets clean[t] for those of `in_doubt` that L9 releases, triangles of the mesh's component `c`,
// ascending, all not clean; all others of the component that are clean touch nothing and share a
// layer.
//
// Two untouched triangles are linked when they alone share an edge (oppositely directed, as mesh
// and ghosts form a cycle); layers continue across links, and pieces are the classes. A piece
// that holds a clean triangle is released: found by flood. Any other has one exact winding
// number (in bounded arithmetic a piece whose number doubles cannot tell stays dirty), and is
// released when its layer is the common one: that of `witnesses`, or, where there are none, the
// layer with most untouched triangles (tie: the one that holds the lowest triangle index).
// "Connected" would not be enough: two tetrahedra, one inside the other, may share an edge (case
// L9_shared_edge_two_layers).
//
// `seen` is scratch by mesh triangle, 0 for those of the component. Costs the triangles in doubt
// and, where there is a piece without a clean triangle, a few passes over the component for the
// winding numbers of all such pieces together. Returns how many of these it took.
std::uint64_t release_pieces(const TouchedSurface& at_instant, std::size_t c,
                             std::span<const std::int32_t> in_doubt,
                             const std::vector<std::int32_t>& witnesses,
                             std::vector<std::uint8_t>& seen, std::vector<std::uint8_t>& clean);

// The same without history: all triangles of the component are in doubt.
std::uint64_t mark_clean_by_layers(const TouchedSurface& at_instant, std::size_t c,
                                   std::vector<std::uint8_t>& seen,
                                   std::vector<std::uint8_t>& clean);

}  // namespace assay::detector
