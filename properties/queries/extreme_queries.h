// Random queries with exponents over all doubles, for the elementary test and the view test: the
// slowest that are known. A fixed family: query `index` of `seed` is the same for ever, so that
// times of one version can be held against those of another.
//
// Most are degenerate, since what is not is settled by doubles: few mantissas, many zeros, points
// that coincide or stay, everything in one plane or on one line, roots next to 1 that many bits
// tell apart (see roots_next_to_one), denormals beside ordinary numbers, neighbouring doubles.
#pragma once

#include <cstdint>

#include "detector/contact/four_points.h"
#include "detector/view/view_filter.h"

namespace assay::properties {

// Vertex-face for even indices, edge-edge for odd ones.
detector::FourPoints extreme_contact(std::uint64_t seed, std::uint64_t index);

struct ViewQuery {
  detector::MovingTriangle triangle;
  detector::ViewPrimitive primitive;
};
// A point for even indices, a line for odd ones.
ViewQuery extreme_view(std::uint64_t seed, std::uint64_t index);

}  // namespace assay::properties
