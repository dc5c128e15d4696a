// Isolates the real roots of a square-free polynomial in the open interval (0,1): finds, for each
// root, an interval that contains no other root.
//
// Method: Descartes' rule over intervals that are split in two until it decides. The two parts of
// an interval have the same number of DOUBLES, not the same length (an interval that begins at 0 is
// split by exponents). So at most some 70 splits lead to any interval, whatever the exponents are.
// isolate_in_gap isolates roots that lie in one gap between adjacent doubles. A list holds the
// intervals that are not done yet, so the stack does not grow with their number.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "detector/exact/polynomial.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// The doubles in [0,1] are numbered by consecutive integers in ascending order: their bits, read
// as an integer.
inline std::uint64_t ordinal(double time) { return std::bit_cast<std::uint64_t>(time); }
inline double from_ordinal(std::uint64_t n) { return std::bit_cast<double>(n); }
inline bool adjacent(double lo, double hi) { return ordinal(hi) == ordinal(lo) + 1; }

// Returns the enclosure of the one root of a function in the open interval (lo, hi). REQUIRES
// doubles lo and hi in [0,1], and that the sign of the function is sign_lo (1 or -1) between lo and
// the root, and the opposite between the root and hi. sign_at(t) is called only for lo < t < hi.
//
// The search starts at the guess and goes towards the root in growing strides of doubles until it
// has passed the root; then it halves the interval. A guess outside (lo, hi) is ignored. If the
// guess is next to the root, two signs are enough.
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

// Descartes' rule counts how often the coefficients of a polynomial in the Bernstein basis over an
// interval change their sign, with zeros left out. The number of roots in the OPEN interval,
// counted with their multiplicities, is that count, or that count minus an even number. So with no
// change there is no root, and with one change there is exactly one, a simple one. Roots at the
// ends of the interval do not matter.
//
// For a polynomial without multiple roots the count becomes 0 or 1 as intervals become short. It
// is 0 if no complex root lies in the disc over the interval, and 1 if exactly one lies in the
// union of the discs around the two equilateral triangles over it (Krandick, Mehlhorn, New bounds
// for the Descartes method, J. Symb. Comput. 41, 2006).
struct SignChanges {
  // The number of sign changes. 0 and 1 are exact. If the true number is 2 or more, `count` is at
  // least 2, and can be smaller than the true number.
  int count = 0;
  // If `count` is 0 or 1: the sign of the polynomial just after the beginning of the interval,
  // which is 0 only if the polynomial is 0 everywhere.
  int first = 0;
};

// Returns the sign changes over (lo,hi). REQUIRES 0 <= lo < hi <= 1. 0.5 us if balls can tell.
SignChanges sign_changes_over(const Polynomial& f, const Dyadic& lo, const Dyadic& hi);

// Returns the sign changes over (0,1).
SignChanges sign_changes_over_unit(const Polynomial& f);

// A root: either its time is known, or it is the only root in an open interval, and simple.
struct IsolatedRoot {
  Dyadic lo, hi;          // the interval; both are the root itself if its time is known
  TimeEnclosure doubles;  // lo and hi, or the adjacent doubles around them
  // The sign of the polynomial between lo and the root; 0 if the time of the root is known.
  int sign_after_lo = 0;
  bool is_time() const { return sign_after_lo == 0; }
};

enum class Roots : std::uint8_t { all, any };

// Returns the roots, ascending; with Roots::any, only one root if there are several. REQUIRES that
// `f` is square-free and has the sign changes over_unit over (0,1).
std::vector<IsolatedRoot> isolate_roots(const Polynomial& f, SignChanges over_unit, Roots scope);

// Isolates roots that lie in one gap between adjacent doubles.
//
// Appends the roots of f in the open gap to `found`, ascending; with Roots::any, one root at most.
// Returns the number of parts of the gap for which sign changes were counted. That number grows
// with the logarithm of the number of bits that separate the roots (root_isolation.cpp), not with
// the number of bits itself.
int isolate_in_gap(const Polynomial& f, TimeEnclosure gap, Roots scope,
                   std::vector<IsolatedRoot>& found);

}  // namespace assay::detector
