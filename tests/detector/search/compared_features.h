// Two edges compared as the detector does it, by both instruction sets.
#pragma once

#include <gtest/gtest.h>

#include <array>

#include "detector/search/feature_pairs.h"

namespace assay::tests {

using EdgeEnds = std::array<std::int32_t, 2>;

// Whether two edges are apart by more than a margin. An edge of equal ends is a point.
inline bool are_apart(const detector::FeaturePoints& points, const EdgeEnds& a, const EdgeEnds& b,
                      const detector::FeatureMargin& margin) {
  const auto corners = [&](const EdgeEnds& ends, detector::TriangleCorners& out) {
    out[0] = out[1] = points[ends[0]].floats();
    out[2] = points[ends[1]].floats();
  };
  detector::TriangleCorners of_a, of_b;
  corners(a, of_a);
  corners(b, of_b);
  const auto found = [&](const detector::BoxKernels& kernels) {
    return kernels.compare_features(of_a, of_b, margin.floats(),
                                    detector::feature_bits::edges(0, 0));
  };
  EXPECT_EQ(found(detector::box_kernels()), found(detector::plain_box_kernels()));
  return found(detector::box_kernels()) == 0;
}

}  // namespace assay::tests
