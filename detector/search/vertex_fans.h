// Finds vertices whose triangles are proved to be in no contact with each other, so that their
// pairs of features need not be compared.
//
// Most candidates of a mesh that hardly moves share a vertex. The fan of a vertex v is the set of
// all triangles that contain v. No two triangles of a fan are in contact during the step if
//   every edge at v is passed as often toward v as away from it;
//   along one axis, all triangles of the fan are seen from one side throughout the step;
//   in that view, at t=0, the triangles lie once around v.
// This is L13 for the fan, whose contour runs around v. It holds also if the contour is more than
// one closed walk.
//
// Proof. At a time t project the fan along the axis. Each triangle (v, p, q) covers an angle below
// 180 degrees at v, from the direction of p to the direction of q, and all triangles turn in one
// sense. Where one triangle ends, at q, another triangle begins, because the edge (v, q) is passed
// both ways equally often. So every direction is covered by the same number of triangles, if the
// first direction of each triangle does not count as covered. This number is an integer, and it
// changes continuously as long as no projected triangle loses its area, so it stays what it is at
// t=0. Let it be 1. Then the angles of two triangles of the fan have at most an end in common, and
// at this end the two triangles have the same edge, because only one triangle begins at the end of
// another, and it shares that edge. The projection of a triangle is one to one, so the two
// triangles have v or that edge in common, and nothing else. So faces of the two without a common
// vertex do not meet.
//
// The number is found by counting the triangles whose p is below v along another axis, and whose q
// is not below v. These triangles cover the horizontal direction on one side of v. On the other
// side of v, triangles go from above to below, because all triangles turn in one sense.
//
// Positions are the floats of FeaturePoint, each off by at most e = 2^-23 (moving_box.h). Let S_k
// be the greatest computed size of an edge along axis k, which is at most 4. An edge is off by 2 e,
// and by its own rounding 2^-24 S_k: together by at most d = 2^-21. A component a_i b_j - a_j b_i
// of the normal is off by 2 d (S_i + S_j) + 2 d^2, and by its roundings 2^-22 S_i S_j <= 2^-20 S_i:
// together by less than 2^-19 (S_i + S_j) + 2^-41. Twice the middle Bernstein coefficient is the
// sum of two such components. It is off by twice this error, and by its rounding, 2^-22 S_i S_j
// once more: together by less than 2^-17 (S_i + S_j) + 2^-39. This is the bound for all three
// coefficients, and a third of it is left for the roundings of the bound itself. If a value is
// beyond the bound, the true positions, the floats and all positions between these two have the
// same sign. So no triangle loses its area between the true positions and the floats, and the
// number, which is exact for the floats, is exact for the true positions.
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
  // Tries to prove the fans of all vertices, over the step of `points`. 25 ns a triangle. If `pace`
  // was stopped, no fan is proved. Memory: 16 bytes a triangle.
  void prove(const Topology& mesh, const FeaturePoints& points, PacedStop* pace);

  // Returns whether two triangles have a common vertex whose fan is proved.
  bool are_apart(std::int32_t a, std::int32_t b) const {
    if (!proved_) return false;
    const Corners &p = proved_[at(a)], &q = proved_[at(b)];
    const auto halves = reinterpret_cast<Halves>((p == q) | (p == Corners{q[1], q[2], q[0], q[3]}) |
                                                 (p == Corners{q[2], q[0], q[1], q[3]}));
    return (halves[0] | halves[1]) != 0;
  }

 private:
  // The corners of a triangle that have a proved fan. Its other corners, and the fourth element,
  // are replaced by a number that no other triangle has.
  using Corners = std::int32_t __attribute__((vector_size(16)));
  using Halves = std::int64_t __attribute__((vector_size(16)));
  std::unique_ptr<Corners[]> proved_;  // by triangle; null before prove()
};

}  // namespace assay::detector
