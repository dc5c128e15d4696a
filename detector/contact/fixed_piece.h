// A piece of the step in exact Bernstein coefficients, and what their signs tell.
//
// Of a polynomial over a piece, zeros among its coefficients left out:
//   - coefficients of one sign, not all zero: that sign throughout the open piece;
//   - the number of sign changes is the number of roots in the open piece, or an even number more
//     (Descartes' rule, by s/(1-s)): none without a change, exactly one, a simple one, with one.
#pragma once

#include <optional>

#include "detector/contact/fixed_sign.h"

namespace assay::detector {

// Of one polynomial over the open piece.
struct PieceSigns {
  int changes = 0;
  int first = 0;  // the sign after the beginning; 0: vanishes throughout
  bool known() const { return changes == 0; }
};

template <class T, std::size_t n>
PieceSigns piece_signs(const std::array<T, n>& coefficients) {
  PieceSigns signs;
  int last = 0;
  for (const auto& c : coefficients) {
    const int sign = c.sign();
    if (sign == 0) continue;
    if (last == 0) signs.first = sign;
    signs.changes += last != 0 && sign != last;
    last = sign;
  }
  return signs;
}

// Which signs occur among some polynomials.
struct SignSet {
  bool positive = false, negative = false;
  void add(int sign) {
    positive |= sign > 0;
    negative |= sign < 0;
  }
  bool both() const { return positive && negative; }
  bool any() const { return positive || negative; }
};

template <std::size_t W>
struct FixedPiece {
  using Minor = typename FixedProducts<W>::Minor;
  using Triple = typename FixedProducts<W>::Triple;
  using Dependency = std::array<FixedQuadratic<Minor>, 4>;

  FixedCubic<Triple> f;
  std::array<std::optional<Dependency>, 3> dependencies;  // made when asked for
  double lo, hi;                                          // dyadic: exact

  // Only the whole step can lack one.
  const Dependency& dependency(std::size_t axis, const FixedProducts<W>& products) {
    auto& l = dependencies[axis];
    if (!l) l = products.dependency(axis);
    return *l;
  }

  // All dependencies must have been made.
  std::array<FixedPiece, 2> halves() const {
    std::array<FixedPiece, 2> out;
    auto& [left, right] = out;
    halve_undivided(f, left.f, right.f);
    for (std::size_t k = 0; k < 3; ++k) {
      left.dependencies[k].emplace();
      right.dependencies[k].emplace();
      for (std::size_t i = 0; i < 4; ++i) {
        halve_undivided((*dependencies[k])[i], (*left.dependencies[k])[i],
                        (*right.dependencies[k])[i]);
      }
    }
    left.lo = lo;
    right.hi = hi;
    left.hi = right.lo = (lo + hi) / 2;
    return out;
  }
};

// A quadratic as a cubic, times 3 in the coefficients: b0, b1, b2, b3 from q0, q1, q2.
template <std::size_t W>
FixedCubic<FixedInteger<3 * W>> raised(const FixedQuadratic<FixedInteger<2 * W>>& quadratic) {
  using Triple = FixedInteger<3 * W>;
  const Triple q0(quadratic[0]), q1(quadratic[1]), q2(quadratic[2]);
  return {q0 + q0 + q0, q0 + q1 + q1, q1 + q1 + q2, q2 + q2 + q2};
}

}  // namespace assay::detector
