// Searches for a place from which a component is viewed. Deterministic: + - * / and sqrt only.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/topology.h"

namespace assay::detector {

// Scores places from which a component can be viewed, by the planes of its triangles, in doubles.
// Scores affect only how fast the detector is, never what it answers.
//
// The component is scaled to size 1 around the origin. The planes are those of at most `most` of
// its triangles, evenly chosen. Each coordinate has an array of its own, because score() reads
// whole arrays.
class ViewPlanes {
 public:
  static constexpr std::size_t most_planes = 20'000;

  ViewPlanes(const Topology& mesh, const Component& component, const PositionsView& x,
             std::size_t most = most_planes);

  // Returns the same component with at most `most` of these triangles and at most `most` of its
  // points, evenly chosen.
  ViewPlanes thinned(std::size_t most) const;

  // Returns the vertices in the order of component.vertices, with coordinates in [-1,1]. If the
  // component is only a few denormals wide, its middle may not be a double, and coordinates are in
  // [-2,2].
  std::span<const Point> points() const { return points_; }
  std::size_t size() const { return offset_.size(); }
  Point to_unit(const Point& x) const;
  Point normal(std::size_t plane) const { return {nx_[plane], ny_[plane], nz_[plane]}; }
  Point middle(std::size_t plane) const;

  // Returns the score of the point q. Triangles that are positive as seen from q add to it, and a
  // little more if they are positive by more than `margin`. If far more triangles are negative, the
  // negative triangles add to the score instead, each with a smaller weight. The reason: a step is
  // free if all triangles have one sign (L4). With the positive sign this holds even if nothing is
  // known at t=0 (L5). Scores of points are comparable with scores of points only, and scores of
  // lines with scores of lines only.
  std::int64_t score(const Point& q) const;
  // Returns the score of the line q0 q1. It is computed in the same way, except that triangles
  // without a sign reduce it, because they cost most.
  std::int64_t score(const Point& q0, const Point& q1) const;
  // What one triangle adds to a score.
  static constexpr std::int64_t for_positive = 8, for_margin = 1, for_negative = 6, for_zero = -4;
  static constexpr double margin = 1.0 / 64;

 private:
  ViewPlanes() = default;

  Point centre_{};
  // Half the largest extent along an axis; larger if the component is tiny.
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

// If `pace` is stopped, a search ends early and returns the places tried so far, at least one.

// Tries places, then moves from the best of them along the axes to better ones, in ever smaller
// steps. Returns all places tried, best first. Places of equal score are in the order in which they
// were tried; means of vertices and of triangles are tried first.
std::vector<ScoredPoint> search_points(const ViewPlanes& planes, PacedStop* pace = nullptr);

// Does the same for lines. It tries lines along the direction in which the component is longest,
// and lines between points that have good scores. The result is never empty, and the ends of a line
// differ unless the component is one point.
std::vector<ScoredLine> search_lines(const ViewPlanes& planes,
                                     const std::vector<ScoredPoint>& points,
                                     PacedStop* pace = nullptr);

}  // namespace assay::detector
