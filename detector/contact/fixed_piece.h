// A piece of the step in exact Bernstein coefficients, and what the signs of the coefficients
// tell.
//
// Leave out the zeros among the coefficients of a polynomial over a piece. Then:
// - If the rest have one sign, the polynomial has that sign throughout the open piece.
// - The number of sign changes is the number of roots in the open piece, or more by an even number
//   (Descartes' rule, by s/(1-s)). So with no change there is no root, and with one change there
//   is exactly one, a simple one.
#pragma once

#include <optional>

#include "detector/contact/fixed_sign.h"

namespace assay::detector {

// The signs of one polynomial over the open piece.
struct PieceSigns {
  int changes = 0;
  int first = 0;  // the sign just after the beginning; 0 if the polynomial vanishes throughout
  bool known() const { return changes == 0; }  // `first` is then the sign throughout
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

// Which of the two strict signs occur among some polynomials.
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
  std::array<std::optional<Dependency>, 3> dependencies;  // computed when asked for
  double lo, hi;                                          // dyadic, and so exact

  // The dependency of this axis, computed now if it is not there yet. Only a piece that is the
  // whole step can lack one, because halves() hands all of them on.
  const Dependency& dependency(std::size_t axis, const FixedProducts<W>& products) {
    auto& l = dependencies[axis];
    if (!l) l = products.dependency(axis);
    return *l;
  }

  // The two halves. REQUIRES that all dependencies have been computed.
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

// The coefficients b0, b1, b2, b3, times 3, of the quadratic q0, q1, q2 written as a cubic.
template <std::size_t W>
FixedCubic<FixedInteger<3 * W>> raised(const FixedQuadratic<FixedInteger<2 * W>>& quadratic) {
  using Triple = FixedInteger<3 * W>;
  const Triple q0(quadratic[0]), q1(quadratic[1]), q2(quadratic[2]);
  return {q0 + q0 + q0, q0 + q1 + q1, q1 + q1 + q2, q2 + q2 + q2};
}

}  // namespace assay::detector
