// Closest points of segments and triangles, for pictures. They are computed in plain doubles of
// any size, and no verdict rests on them.
#pragma once

#include <Eigen/Core>
#include <array>

namespace assay::reports {

struct NearestPoints {
  Eigen::Vector3d a, b;  // one on each
  double distance() const { return (a - b).stableNorm(); }
  Eigen::Vector3d middle() const { return 0.5 * (a + b); }
};

NearestPoints nearest_of_segments(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                                  const Eigen::Vector3d& b0, const Eigen::Vector3d& b1);

// The closest points of a point and a closed triangle. A triangle without area counts as its
// longest edge.
NearestPoints nearest_of_triangle(const Eigen::Vector3d& point,
                                  const std::array<Eigen::Vector3d, 3>& corners);

}  // namespace assay::reports
