// In which numbers a step is computed. What each promises: detector/README.md.
#pragma once

#include <cstdint>

namespace assay::detector {

enum class Arithmetic : std::uint8_t {
  exact,             // doubles with proved bounds, integers where these cannot tell: never wrong
  bounded,           // doubles with proved bounds alone: what they cannot tell counts as contact
  double_precision,  // the same ladder with bounds 0: no promise, made to be measured
  single_precision,  // likewise in float, of coordinates rounded to float
};

}  // namespace assay::detector
