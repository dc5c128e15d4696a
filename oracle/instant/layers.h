// Layers, pieces and clean triangles of a mesh at one instant, found from the places at that
// instant alone, without history (L9 and L10, detector/README.md).
#pragma once

#include <optional>
#include <vector>

#include "detector/mesh/types.h"
#include "oracle/instant/winding.h"

namespace assay::oracle {

// Each list has one element for each triangle of the mesh, unless its comment says otherwise.
struct LayerState {
  // The component of each triangle, then of each ghost. A component is what is connected through
  // shared vertices, ghosts included. Components are numbered in the order of their lowest
  // triangle.
  std::vector<std::int32_t> component;
  // 1: the triangle meets another triangle of its own component, or a ghost of that component.
  std::vector<std::uint8_t> touched;
  // The number of the piece that the triangle is in; -1: the triangle is touched. Two untouched
  // triangles are linked when they share an edge that no other triangle and no ghost has, and pass
  // it in opposite directions. Pieces are the classes of linked triangles, numbered in the order
  // of their lowest triangle.
  std::vector<std::int32_t> piece;
  // The layer of the triangle: winding numbers of its own component. Nothing for a touched
  // triangle.
  std::vector<std::optional<Layer>> layer;
  // By component: the common layer, which is that of most of its untouched triangles. If two
  // layers have equally many, it is the one that holds the lowest triangle. Nothing when all are
  // touched.
  std::vector<std::optional<Layer>> common;
  // 1: the triangle is untouched, and its layer is the common layer of its component.
  std::vector<std::uint8_t> clean;
};

// REQUIRES closes(triangles, ghosts), indices in range; ghosts name vertices of this instant too.
// Contacts between two components make nothing dirty here, because such pairs are always
// candidates and the layers of a component count that component alone (L10). Every untouched
// triangle has a normal: one of zero area is always touched, by the triangle or ghost at its
// longest edge, and one that repeats an index counts as touched.
LayerState layers_at(const Instant& instant, const detector::TrianglesView& triangles,
                     const detector::TrianglesView& ghosts, int jobs = 1);

}  // namespace assay::oracle
