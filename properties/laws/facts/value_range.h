// The smallest and the largest magnitude of the values that a law rests on in one step, such as the
// determinants whose signs it compares. A value near 0 beside large ones means that the law was
// tried close to where rounding could break it.
#pragma once

#include <algorithm>
#include <limits>

namespace assay::properties {

// The range of magnitudes, none of them negative. At first it holds no value.
struct ValueRange {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0;

  void widen(double size) { widen({size, size}); }
  void widen(const ValueRange& other) {
    smallest = std::min(smallest, other.smallest);
    largest = std::max(largest, other.largest);
  }
};

inline constexpr double close_share = 0.01;
// Whether the smallest is at most 1 % of the largest.
inline bool is_close(const ValueRange& range) {
  return range.smallest <= close_share * range.largest;
}

}  // namespace assay::properties
