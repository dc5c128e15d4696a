// Times of the closed step as exact numbers, whichever way they are held, and the doubles between
// which they are.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "detector/mesh/step_types.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

// Distinct times in [0,1], ascending.
class ExactTimes {
 public:
  ExactTimes() = default;
  virtual ~ExactTimes() = default;
  ExactTimes(const ExactTimes&) = delete;
  ExactTimes& operator=(const ExactTimes&) = delete;

  virtual int size() const = 0;
  // The exact sign of q at the i-th time.
  virtual int sign(const IntegerPolynomial& q, int i) const = 0;
  virtual detector::TimeEnclosure enclosure(int i) const = 0;
};

// The canonical enclosure of a time in [lo,hi] that can only be compared with doubles. REQUIRES 0
// <= lo <= hi, and that compare(t) is the exact sign of (time - t); it is asked of doubles in
// [lo,hi] only. A wrong guess costs only work: when it is n units in the last place away, about 2
// log2 n comparisons.
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

// A zero of f in [s,e] in plain doubles: only a guess, so it has no error bound. f is of degree 6
// at most, and `sign_at_s` is its sign at s, opposite to that at e.
double guess_zero(const IntegerPolynomial& f, double s, double e, int sign_at_s);

// Encloses the zero of f in (s,e) by exact integer signs of f at doubles, without the algebraic
// kernel. REQUIRES that f is of degree 6 at most, that it has exactly one zero in (s,e), a simple
// one, and opposite signs at s and e, and that 0 <= s < e <= 1. 1 to 3 us.
detector::TimeEnclosure simple_zero_time(const IntegerPolynomial& f, double s, double e);

}  // namespace assay::oracle
