// Finds the enclosure in doubles of a root that is the only one between two doubles, by exact
// signs.
#pragma once

#include <bit>
#include <cstdint>

#include "detector/mesh/step_types.h"

namespace assay::detector {

// The doubles in [0,1] are numbered by consecutive integers in ascending order: their bits, read
// as an integer.
inline std::uint64_t ordinal(double time) { return std::bit_cast<std::uint64_t>(time); }
inline double from_ordinal(std::uint64_t n) { return std::bit_cast<double>(n); }
inline bool adjacent(double lo, double hi) { return ordinal(hi) == ordinal(lo) + 1; }

// The enclosure of the one root of a function in the open interval (lo, hi). REQUIRES doubles lo
// and hi in [0,1], and that the sign of the function is sign_lo (1 or -1) between lo and the root,
// and the opposite between the root and hi. sign_at(t) is asked only for times t inside.
//
// The search starts at the guess and goes towards the root in growing strides of doubles until it
// has passed the root; then it halves. A guess outside (lo, hi) is ignored. If the guess is next
// to the root, two signs are enough.
template <class SignAt>
TimeEnclosure bracket_root(SignAt sign_at, int sign_lo, double lo, double hi, double guess) {
  if (guess > lo && guess < hi) {
    std::uint64_t stride = 1;
    double from = guess;
    const int sign = sign_at(from);
    if (sign == 0) return {from, from};
    const bool upward = sign == sign_lo;
    while (true) {
      (upward ? lo : hi) = from;
      const std::uint64_t room = upward ? ordinal(hi) - ordinal(from) : ordinal(from) - ordinal(lo);
      if (stride >= room) break;
      const double next = from_ordinal(upward ? ordinal(from) + stride : ordinal(from) - stride);
      const int sign_next = sign_at(next);
      if (sign_next == 0) return {next, next};
      if (sign_next != sign) {
        (upward ? hi : lo) = next;
        break;
      }
      from = next;
      stride *= 8;
    }
  }
  while (!adjacent(lo, hi)) {
    const double middle = from_ordinal((ordinal(lo) + ordinal(hi)) / 2);
    const int sign = sign_at(middle);
    if (sign == 0) return {middle, middle};
    (sign == sign_lo ? lo : hi) = middle;
  }
  return {lo, hi};
}

}  // namespace assay::detector
