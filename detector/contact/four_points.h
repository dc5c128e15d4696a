// The common form of the two elementary queries: four moving points in two groups.
//
// The groups of a vertex-face query are {0} | {1,2,3}, those of an edge-edge query {0,1} | {2,3}.
// The features are the closed convex hulls of the groups, whatever these have become: a zero-area
// triangle is the segment or point that is left of it. A contact at t means that the two hulls
// meet at t.
#pragma once

#include "detector/mesh/step_types.h"

namespace assay::detector {

struct FourPoints {
  std::array<MovingPoint, 4> points;
  int first_group = 1;  // number of points in the first group: 1 or 2
  bool in_first_group(int i) const { return i < first_group; }
};

inline FourPoints four_points(const VertexFace& q) {
  return {{q.vertex, q.face[0], q.face[1], q.face[2]}, 1};
}

inline FourPoints four_points(const EdgeEdge& q) { return {{q.a[0], q.a[1], q.b[0], q.b[1]}, 2}; }

}  // namespace assay::detector
