// Polynomials in the step's time with exact integer coefficients. The detector's are of degree 5
// at most (the middle piece of a view-line); none is limited here.
#pragma once

#include <boost/container/small_vector.hpp>

#include "detector/exact/integer.h"

namespace assay::detector {

// A time m * 2^e, exact.
struct Dyadic {
  Integer mantissa = 0;
  int exponent = 0;  // at most 0 for every time in [0,1]
  static Dyadic of(double time);
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
};

class Polynomial {
 public:
  Polynomial() = default;  // zero
  static Polynomial constant(const Integer& value);
  // value_t0 + t (value_t1 - value_t0)
  static Polynomial linear(const Integer& value_t0, const Integer& value_t1);

  bool is_zero() const { return coefficients_.empty(); }
  int degree() const { return static_cast<int>(coefficients_.size()) - 1; }  // -1 for zero
  const Integer& operator[](int power) const {
    return coefficients_[static_cast<std::size_t>(power)];
  }
  const Integer& leading() const { return coefficients_.back(); }

  friend Polynomial operator+(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  Polynomial operator-() const;

  Polynomial derivative() const;
  // A positive multiple of f(lo + s (hi - lo)) as a polynomial in s; lo < hi.
  Polynomial over(const Dyadic& lo, const Dyadic& hi) const;

  // Sign (-1, 0, 1) at a time; exact. 0.1 us unless nearly all of its terms cancels there (ball.h).
  int sign_at(const Dyadic& time) const;
  // Signs at t = 0 and t = 1 without a Dyadic.
  int sign_at_zero() const;
  int sign_at_one() const;

  // By an integer that divides every coefficient.
  void divide_exactly(const Integer& divisor);
  // By the greatest power of two that does so.
  void take_out_powers_of_two();
  // The pseudo-remainder of this by `divisor` (not zero): that of this times |leading
  // coefficient|^(difference of degrees + 1). This itself where its degree is the lower one.
  Polynomial remainder(const Polynomial& divisor) const;
  // This divided by a polynomial that divides it up to a constant; up to a non-zero constant, but
  // with integers no longer than those of this and some bits.
  Polynomial quotient(const Polynomial& divisor) const;

  static constexpr std::size_t inline_coefficients = 6;

 private:
  void trim();
  // Ascending powers, the last one not zero.
  boost::container::small_vector<Integer, inline_coefficients> coefficients_;
};

}  // namespace assay::detector
