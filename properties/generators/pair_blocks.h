// The blocks of triangle pairs by the view sets of their two triangles.
#pragma once

#include <cstddef>
#include <cstdint>

#include "detector/mesh/step_types.h"

namespace assay::properties {

// The view sets of a pair's two triangles (L3, detector/README.md). A triangle in Vv counts as
// violated, whatever its sign.
enum class PairBlock : std::uint8_t {
  positive_negative,
  positive_zero,
  negative_zero,
  zero_zero,
  violated,  // at least one triangle is in Vv
  positive_positive,
  negative_negative,  // the last two are outside K, unless in two groups
};
inline constexpr std::size_t pair_blocks = 7;

const char* name_of(PairBlock block);
PairBlock block_of(detector::ViewSign a, detector::ViewSign b, bool either_violated);

}  // namespace assay::properties
