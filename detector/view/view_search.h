// The search for a place to view a component from. Deterministic: + - * / and sqrt only.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// Scores how good a place to view from is, by the planes of a component's triangles, in double. A
// score decides only how fast the detector is, never what it answers.
//
// A component scaled to size 1 around the origin, and the planes of at most `most` of its
// triangles, evenly chosen. Each coordinate has an array of its own, because a score reads whole
// arrays.
class ViewPlanes {
 public:
  static constexpr std::size_t most_planes = 20'000;

  ViewPlanes(const Topology& mesh, const Component& component, const PositionsView& x,
             std::size_t most = most_planes);

  // Returns the same component with at most `most` of these triangles and as many of its points,
  // evenly chosen.
  ViewPlanes thinned(std::size_t most) const;

  // Returns the vertices in the order of component.vertices, with coordinates in [-1,1] (in [-2,2]
  // if the component is only a few denormals wide, so that there may be no double in the middle).
  std::span<const Point> points() const { return points_; }
  std::size_t size() const { return offset_.size(); }
  Point to_unit(const Point& x) const;
  Point normal(std::size_t plane) const { return {nx_[plane], ny_[plane], nz_[plane]}; }
  Point middle(std::size_t plane) const;

  // Returns the score of the point q. It counts the triangles that are positive seen from q, and a
  // little more for those that are positive by more than `margin`. If far more triangles are
  // negative, it counts the negative ones instead, each for less. The gain comes from one sign for
  // all triangles (L4); with the sign positive, it comes even if nothing is known of the start
  // (L5). Compare scores of points with scores of points, and scores of lines with scores of lines.
  std::int64_t score(const Point& q) const;
  // Returns the score of the line q0 q1. It is counted in the same way, and triangles without a
  // sign are subtracted, because they cost most.
  std::int64_t score(const Point& q0, const Point& q1) const;
  // The contribution of one triangle to a score.
  static constexpr std::int64_t for_positive = 8, for_margin = 1, for_negative = 6, for_zero = -4;
  static constexpr double margin = 1.0 / 64;

 private:
  ViewPlanes() = default;

  Point centre_{};
  // Half the greatest extent along an axis; enlarged if the component is tiny.
  double scale_ = 0;
  bool is_tiny_ = false;
  std::vector<Point> points_;
  std::vector<double> nx_, ny_, nz_, offset_;  // unit normal n; n.p for the points p of the plane
  std::vector<std::array<Point, 3>> corners_;
};

struct ScoredPoint {
  Point q;
  std::int64_t score;
};

struct ScoredLine {
  Point q0, q1;
  std::int64_t score;
};

// If `pace` is given and says to end, a search ends early. It returns the places tried so far, one
// at least.

// Tries places, then descends from the best ones along the axes, in ever smaller steps. Returns
// all places tried, best first; among equals the one tried first, where means of vertices and
// triangles are tried before all others.
std::vector<ScoredPoint> search_points(const ViewPlanes& planes, PacedStop* pace = nullptr);

// Does the same for lines. It tries lines along the direction in which the component extends most,
// and lines between points that are good by themselves. Never empty; the ends differ unless the
// component is one point.
std::vector<ScoredLine> search_lines(const ViewPlanes& planes,
                                     const std::vector<ScoredPoint>& points,
                                     PacedStop* pace = nullptr);

}  // namespace assay::detector
