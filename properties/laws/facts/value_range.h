// The smallest and the largest of the values that a law rests on in one step. They tell how close
// it came.
#pragma once

#include <algorithm>
#include <limits>

namespace assay::properties {

// The range of the sizes of values. At first it holds no value.
struct ValueRange {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0;

  void widen(double size) { widen({size, size}); }
  void widen(const ValueRange& other) {
    smallest = std::min(smallest, other.smallest);
    largest = std::max(largest, other.largest);
  }
};

// The smallest is at most 1 % of the largest.
inline constexpr double close_share = 0.01;
inline bool is_close(const ValueRange& range) {
  return range.smallest <= close_share * range.largest;
}

}  // namespace assay::properties
