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

// If `pace` is given and says to end, a search ends early. It returns the places tried so far, one
// at least.

// Tries places, then descends from the best ones along the axes, in ever smaller steps. Returns
// all places tried, best first; among equals the one tried first, where means of vertices and
// triangles are tried before all others.
std::vector<ScoredPoint> search_points(const ViewPlanes& planes, PacedStop* pace = nullptr);

// The same for lines. It tries lines along the direction in which the component extends most, and
// lines between points that are good by themselves. Never empty; the ends differ unless the
// component is one point.
std::vector<ScoredLine> search_lines(const ViewPlanes& planes,
                                     const std::vector<ScoredPoint>& points,
                                     PacedStop* pace = nullptr);

}  // namespace assay::detector
