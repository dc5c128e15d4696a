// Where two triangles meet or are nearest to each other, for pictures. It is computed in plain
// doubles, and no verdict rests on it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "detector/mesh/step_types.h"

namespace assay::reports {

struct NearestPoints {
  Eigen::Vector3d a, b;  // one on each
  double distance() const { return (a - b).stableNorm(); }
  Eigen::Vector3d middle() const { return 0.5 * (a + b); }
};

// The closest points, at time t in [0,1] of the step, of the two features of a contact. In a
// contact they coincide up to rounding. Exactly one point: where a piercing edge crosses the plane,
// and the centre of triangles with the same vertices. If no feature is named, as by a plug-in: the
// closest points of the two triangles, by what they do not share. Nothing if there is no such
// place, because all features share a vertex, or because it overflows.
std::optional<NearestPoints> contact_places(const detector::PairContact& contact,
                                            const detector::TrianglesView& triangles,
                                            const detector::PositionsView& x_t0,
                                            const detector::PositionsView& x_t1, double t);

// Closest points of segments and triangles, in doubles of any size.

NearestPoints nearest_of_segments(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                                  const Eigen::Vector3d& b0, const Eigen::Vector3d& b1);

// The closest points of a point and a closed triangle. A triangle without area counts as its
// longest edge.
NearestPoints nearest_of_triangle(const Eigen::Vector3d& point,
                                  const std::array<Eigen::Vector3d, 3>& corners);

}  // namespace assay::reports
