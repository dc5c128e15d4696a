// Layers, pieces and clean triangles of a mesh at one instant, found only from the places at that
// instant, without history (L9 and L10, detector/LAWS.md); and exact winding numbers of a cycle,
// found by counting how often a ray crosses it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "detector/mesh/types.h"
#include "oracle/instant/instant.h"

namespace assay::oracle {

// The winding numbers beside a triangle: `inside` just behind it, `outside` just in front, where
// the normal points. Always (w, w - 1).
struct Layer {
  int inside = 0, outside = 0;
  friend auto operator<=>(const Layer&, const Layer&) = default;
};

using RationalPoint = std::array<mpq_class, 3>;

// The winding number w of a cycle at one instant: w is 0 far away, and drops by 1 across each
// triangle in the direction of its normal. Zero-area triangles bound nothing and add nothing. A
// query follows a ray that runs nearly along the x axis, so it costs a few determinants (10 to 100
// us); one box tree serves all queries.
class WindingField {
 public:
  // REQUIRES a cycle (every directed edge occurs as often as its reverse), indices in range. The
  // instant has to outlive the field.
  WindingField(const Instant& instant, detector::Triangles cycle);

  // Returns the winding number at the point; nothing when the point is on a triangle. Exact for
  // every finite double and every rational.
  std::optional<int> at(const detector::Point& point) const;
  std::optional<int> at(const RationalPoint& point) const;

  // Returns the layer of a triangle of the cycle. REQUIRES that its area is not zero and that no
  // other triangle contains its centroid. (If the triangle is in no contact, no other triangle
  // contains it.)
  Layer layer_of(std::int32_t triangle) const;

 private:
  struct Ray;
  std::optional<int> crossings(const Ray& ray, int direction, std::int32_t skipped) const;
  bool on_surface(const Ray& ray) const;

  const Instant& instant_;
  detector::Triangles cycle_;
  Box bounds_{};
  std::unique_ptr<BoxTree> tree_;
};

// Each list has one element for each triangle of the mesh, unless its comment says otherwise.
struct LayerState {
  // The component of each triangle, then the component of each ghost. A component is a set of
  // triangles connected through shared vertices, ghosts included. Components are numbered in the
  // order of their lowest triangle.
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
  // For each component, its common layer: the layer that most of its untouched triangles have. If
  // two layers have equally many triangles, the common layer is the one with the lowest-numbered
  // triangle. Nothing when all triangles of the component are touched.
  std::vector<std::optional<Layer>> common;
  // 1: the triangle is untouched, and its layer is the common layer of its component.
  std::vector<std::uint8_t> clean;
};

// Finds the layers. REQUIRES closes(triangles, ghosts), and that triangles and ghosts name vertices
// of this instant. Contacts between two components make no triangle dirty here, because pairs of
// two components are always candidates, and the layers of a component are winding numbers of only
// that component (L10). Every untouched triangle has a normal: a triangle of zero area is always
// touched, by the triangle or ghost at its longest edge, and a triangle that repeats an index
// counts as touched.
LayerState layers_at(const Instant& instant, const detector::TrianglesView& triangles,
                     const detector::TrianglesView& ghosts);

}  // namespace assay::oracle
