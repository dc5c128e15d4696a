// Vertices whose neighbours are proved apart, so that their pairs of features need not be compared.
//
// Most candidates of a mesh that hardly moves share a vertex. The fan of a vertex v consists of all
// triangles that hold v. Two of them are in no contact during the step if
//   every edge at v is passed as often toward v as away from it;
//   along one axis, all triangles of the fan are seen from one side throughout the step;
//   in that view, at t=0, the triangles lie once around v.
// This is L13 for the fan, whose contour runs around v, but it holds also where a contour of more
// than one walk would have to be looked at.
//
// Proof. At a time t project the fan along the axis. Each triangle (v, p, q) covers an angle below
// 180 degrees at v, from the direction of p up to that of q, and all turn in one sense. Wherever
// one of them ends, at q, another one begins, because the edge (v, q) is passed both ways equally
// often. So every direction is covered by the same number of triangles, if each is taken without
// its first direction. This number is an integer, and it changes continuously as long as no
// projected triangle loses its area: it stays as at t=0. If it is 1, two triangles of the fan have
// at most an end of their angles in common, and there they have the same edge, because a single
// triangle begins at the end of one of them, and it shares that edge. The projection of a triangle
// is one to one, so the two triangles have v or that edge in common, and nothing else. Faces of
// theirs without a common vertex do not meet there.
//
// The number is found by counting the triangles whose p is below v along another axis, and whose q
// is not. These triangles cover the level direction on one side. On the other side triangles go
// from above to below, because all turn in one sense.
//
// Positions are the floats of FeaturePoint, each off by e = 2^-23 at most (moving_box.h). Let S_k
// be the greatest size of an edge along axis k, at most 4, as computed. An edge is off by twice e
// and by its own rounding, 2^-24 S_k: by d = 2^-21 at most. A component a_i b_j - a_j b_i of the
// normal is off by 2 d (S_i + S_j) + 2 d^2, and by its roundings, 2^-22 S_i S_j <= 2^-20 S_i: by
// less than 2^-19 (S_i + S_j) + 2^-41. Twice the middle Bernstein coefficient is the sum of two
// such components. It is off by twice that, and by its rounding, 2^-22 S_i S_j once more: by less
// than 2^-17 (S_i + S_j) + 2^-39. This bound holds for all three coefficients, and leaves a third
// of itself for its own roundings. Beyond it the sign is that of the true positions, of the floats,
// and of all positions between these two. So no triangle loses its area between them either, and
// the number, which is exact for the floats, is true.
#pragma once

#include <cstdint>
#include <memory>

#include "detector/boxes/moving_box.h"
#include "detector/mesh/paced_stop.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

class FeaturePoints;

class VertexFans {
 public:
  // Looks at the fans of all vertices, over the step of the points. 25 ns a triangle. If `pace` was
  // stopped, no fan is proved. Memory: 16 bytes a triangle.
  void prove(const Topology& mesh, const FeaturePoints& points, PacedStop* pace);

  // Returns whether two triangles have a vertex in common whose fan is proved apart.
  bool are_apart(std::int32_t a, std::int32_t b) const {
    if (!proved_) return false;
    const Corners &p = proved_[at(a)], &q = proved_[at(b)];
    const auto halves = reinterpret_cast<Halves>((p == q) | (p == Corners{q[1], q[2], q[0], q[3]}) |
                                                 (p == Corners{q[2], q[0], q[1], q[3]}));
    return (halves[0] | halves[1]) != 0;
  }

 private:
  // The corners of a triangle whose fans are proved. In place of its other corners, and in the
  // fourth place, stands a number that no other triangle has.
  using Corners = std::int32_t __attribute__((vector_size(16)));
  using Halves = std::int64_t __attribute__((vector_size(16)));
  std::unique_ptr<Corners[]> proved_;  // by triangle; null before prove()
};

}  // namespace assay::detector
