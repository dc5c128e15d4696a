// The search for a place to view a component from. Deterministic: + - * / and sqrt only.
#pragma once

#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/view/view_planes.h"

namespace assay::detector {

struct ScoredPoint {
  Point q;
  std::int64_t score;
};

struct ScoredLine {
  Point q0, q1;
  std::int64_t score;
};

// The searches end early, with what was tried so far and at least one place, when `pace`, where
// given, says so.

// All places tried, best first; among equals the earlier tried: means of vertices and triangles
// come first. From the best ones a descent in ever smaller steps along the axes.
std::vector<ScoredPoint> search_points(const ViewPlanes& planes, PacedStop* pace = nullptr);

// The same for lines: along the long thin direction, and between points that are good by
// themselves. Never empty; the ends differ unless the component is one point.
std::vector<ScoredLine> search_lines(const ViewPlanes& planes,
                                     const std::vector<ScoredPoint>& points,
                                     PacedStop* pace = nullptr);

}  // namespace assay::detector
