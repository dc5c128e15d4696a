// Layers, pieces and clean triangles of a mesh at one instant, without history (L9 and L10,
// detector/README.md).
#pragma once

#include <optional>
#include <vector>

#include "detector/mesh/types.h"
#include "oracle/instant/winding.h"

namespace assay::oracle {

// By triangle of the mesh, unless said otherwise.
struct LayerState {
  // Component of each triangle, then of each ghost: connected through shared vertices, ghosts
  // included. Numbered by their lowest triangle.
  std::vector<std::int32_t> component;
  // 1: meets another triangle of its component, or a ghost of it.
  std::vector<std::uint8_t> touched;
  // Two untouched triangles are linked when they alone (of mesh and ghosts) share an edge, in
  // opposite directions; pieces are the classes, numbered by their lowest triangle. -1: touched.
  std::vector<std::int32_t> piece;
  // Winding numbers of the triangle's own component; nothing for a touched triangle.
  std::vector<std::optional<Layer>> layer;
  // By component: the layer of most of its untouched triangles (tie: the layer that holds the
  // lowest triangle). Nothing when all are touched.
  std::vector<std::optional<Layer>> common;
  // 1: untouched, and of the common layer of its component.
  std::vector<std::uint8_t> clean;
};

// Ghosts name vertices of the same instant. REQUIRES closes(triangles, ghosts), indices in range.
// Contacts between two components make nothing dirty here: such pairs are always candidates, and
// layers count the own component (L10). A zero-area triangle is always touched, by the triangle or
// ghost at its longest edge, and one that repeats an index counts as touched, so every untouched
// triangle has a normal.
LayerState layers_at(const Instant& instant, const detector::TrianglesView& triangles,
                     const detector::TrianglesView& ghosts, int jobs = 1);

}  // namespace assay::oracle
