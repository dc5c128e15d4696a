// A time of the step as a fraction, for questions about one instant.
#pragma once

#include <cstdint>

namespace assay::oracle {

// t = numerator / denominator, in [0, 1]; denominator > 0. The fraction need not be in lowest
// terms: 1/2 and 2/4 are the same time.
struct RationalTime {
  std::int64_t numerator = 0, denominator = 1;
};

}  // namespace assay::oracle
