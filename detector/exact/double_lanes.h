// Doubles side by side, for code that is compiled once for each instruction set
// (view_lanes_kernel.h, query_lanes_kernel.h). ASSAY_LANES is the number of doubles; a file defines
// it before it includes this one. Everything here has internal linkage and is always inlined,
// because code for one instruction set must not be linked into code for another.
#pragma once

#include <cstddef>

namespace assay::detector {
namespace {

constexpr std::size_t lane_count = ASSAY_LANES;
typedef double Lanes __attribute__((vector_size(8 * ASSAY_LANES)));
using Mask = decltype(Lanes{} < Lanes{});  // integers, -1 where true

#define ASSAY_INLINE inline __attribute__((always_inline))

ASSAY_INLINE Lanes all(double value) { return value - Lanes{}; }

ASSAY_INLINE void lesser(Lanes& least, const Lanes& value) {
  least = value < least ? value : least;
}

ASSAY_INLINE void greater(Lanes& greatest, const Lanes& value) {
  greatest = value > greatest ? value : greatest;
}

}  // namespace
}  // namespace assay::detector
