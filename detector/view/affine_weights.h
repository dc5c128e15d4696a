// A point as a fixed affine combination of a few vertices around it, so that it moves with them.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/types.h"

namespace assay::detector {

struct AffineWeights {
  std::vector<std::int32_t> vertices;  // at most 54
  std::vector<double> weights;         // sum 1
};

// Weights of the nearest vertex in each of 54 directions around the point, by the inverse of the
// squared distance, corrected by the least (weighted) change that reproduces the point; uncorrected
// in directions in which the vertices do not extend, and where the correction would make a weight
// large. `points`: positions of `vertices`, of size about 1. Deterministic: + - * / only. O(n).
AffineWeights affine_weights(std::span<const std::int32_t> vertices, std::span<const Point> points,
                             const Point& point);

// The combination at these positions; finite for finite positions. The same bytes on every machine.
Point combine(const AffineWeights& affine, const PositionsView& x);

}  // namespace assay::detector
