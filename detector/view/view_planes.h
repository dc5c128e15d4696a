// How good a place to view from is: the planes of a component's triangles, scored in double. A
// score decides only how fast the detector is.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/topology.h"

namespace assay::detector {

// A component brought to size 1 around the origin, and its triangles' planes, one array a
// coordinate: a score reads all of one array. At most `most` triangles, evenly chosen.
class ViewPlanes {
 public:
  static constexpr std::size_t most_planes = 20'000;

  ViewPlanes(const Topology& mesh, const Component& component, const PositionsView& x,
             std::size_t most = most_planes);

  // The same component by at most `most` of these triangles and as many of its points, evenly
  // chosen.
  ViewPlanes thinned(std::size_t most) const;

  // Points by place in component.vertices, coordinates in [-1,1] (in [-2,2] where the component is
  // of few denormals, between which there is no middle).
  std::span<const Point> points() const { return points_; }
  std::size_t size() const { return offset_.size(); }
  Point to_unit(const Point& x) const;
  Point normal(std::size_t plane) const { return {nx_[plane], ny_[plane], nz_[plane]}; }
  Point middle(std::size_t plane) const;

  // Positive triangles seen from q, those by more than `margin` counted a little more; or negative
  // ones, where they are far more: one sign is what pays (L4), positive also when nothing is known
  // (L5). Comparable among points, and among lines.
  std::int64_t score(const Point& q) const;
  // The same for the line q0 q1, less the triangles without a sign, which cost most.
  std::int64_t score(const Point& q0, const Point& q1) const;
  // Scores of one triangle.
  static constexpr std::int64_t for_positive = 8, for_margin = 1, for_negative = 6, for_zero = -4;
  static constexpr double margin = 1.0 / 64;

 private:
  ViewPlanes() = default;

  Point centre_{};
  // Half the greatest extent along an axis; enlarged where the component is tiny.
  double scale_ = 0;
  bool is_tiny_ = false;
  std::vector<Point> points_;
  std::vector<double> nx_, ny_, nz_, offset_;  // unit normal n, n.p for p of the plane
  std::vector<std::array<Point, 3>> corners_;
};

}  // namespace assay::detector
