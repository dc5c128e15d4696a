// Finds the canonical enclosure by doubles of a time that can only be compared with doubles.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// The enclosure of a time in [lo,hi]. REQUIRES 0 <= lo <= hi, and that compare(t) is the exact
// sign of (time - t); it is asked of doubles in [lo,hi] only. A wrong guess costs only work: when
// it is n units in the last place away, about 2 log2 n comparisons.
template <class Compare>
detector::TimeEnclosure enclose_time(double guess, double lo, double hi, Compare compare) {
  // Doubles >= 0 are ordered as their bit patterns.
  auto bits = [](double t) { return std::bit_cast<std::uint64_t>(t); };
  auto value = [](std::uint64_t b) { return std::bit_cast<double>(b); };
  const std::uint64_t least = bits(lo + 0.0), greatest = bits(hi + 0.0);  // no -0
  if (!(guess > lo)) guess = lo;
  if (guess > hi) guess = hi;

  std::uint64_t at = bits(guess + 0.0);
  const int first = compare(value(at));
  if (first == 0) return {value(at), value(at)};
  // Takes steps that double until the time is passed, then halves.
  std::uint64_t below = at, above = at;
  for (std::uint64_t step = 1;; step *= 2) {
    if (first > 0) {
      below = at;
      at += std::min(step, greatest - at);
    } else {
      above = at;
      at -= std::min(step, at - least);
    }
    const int side = compare(value(at));
    if (side == 0) return {value(at), value(at)};
    if (side != first) {
      (first > 0 ? above : below) = at;
      break;
    }
  }
  while (above - below > 1) {
    const std::uint64_t middle = below + (above - below) / 2;
    const int side = compare(value(middle));
    if (side == 0) return {value(middle), value(middle)};
    (side > 0 ? below : above) = middle;
  }
  return {value(below), value(above)};
}

}  // namespace assay::oracle
