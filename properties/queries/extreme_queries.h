// Random queries with exponents over all doubles, for the elementary test and the view test: the
// slowest that are known. The family is fixed: query `index` of `seed` is the same for ever, so
// that the times of two versions can be compared.
//
// Most are degenerate, because doubles settle the others: few mantissas, many zeros, points that
// coincide or stay, everything in one plane or on one line, roots next to 1 that many bits tell
// apart (see roots_next_to_one), denormals beside ordinary numbers, neighbouring doubles.
#pragma once

#include <cstdint>

#include "detector/mesh/step_types.h"
#include "detector/view/view_filter.h"

namespace assay::properties {

// A vertex-face query for even indices, an edge-edge query for odd ones.
detector::FourPoints extreme_contact(std::uint64_t seed, std::uint64_t index);

struct ViewQuery {
  detector::MovingTriangle triangle;
  detector::ViewPrimitive primitive;
};
// Seen from a point for even indices, from a line for odd ones.
ViewQuery extreme_view(std::uint64_t seed, std::uint64_t index);

}  // namespace assay::properties
