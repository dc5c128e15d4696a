// Expresses a point as a fixed affine combination of a few vertices around it, so that it moves
// with them.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/types.h"

namespace assay::detector {

struct AffineWeights {
  std::vector<std::int32_t> vertices;  // at most 54
  std::vector<double> weights;         // by place in `vertices`; their sum is 1
};

// The weights of the nearest vertex in each of 54 directions around the point. They are the
// inverses of the squared distances, corrected by the least (weighted) change with which the
// combination is the point itself. There is no correction in directions in which the vertices do
// not extend, and none at all if it would make the weights large. `points` holds the positions of
// `vertices`; REQUIRES coordinates of size about 1. Deterministic: + - * / only. O(n).
AffineWeights affine_weights(std::span<const std::int32_t> vertices, std::span<const Point> points,
                             const Point& point);

// The point that is the combination of the vertices at positions x. Finite for finite positions,
// and the same bytes on every machine.
Point combine(const AffineWeights& affine, const PositionsView& x);

}  // namespace assay::detector
