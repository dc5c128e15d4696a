// Integers without bound, and polynomials in the step's time that have them as coefficients. The
// polynomials of contacts and views have at most degree 5 (the middle piece of a view-line), and
// the polynomials of distances have at most degree 6. The class does not limit the degree.
#pragma once

#include <boost/container/small_vector.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <span>

namespace assay::detector {

// The exact integers of the last rung. Most values of a query fit into the inline storage, so that
// no memory is allocated. Larger ones allocate memory and stay exact.

inline constexpr unsigned inline_integer_bits = 512;

using Integer = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<
        inline_integer_bits, 0, boost::multiprecision::signed_magnitude,
        boost::multiprecision::unchecked, std::allocator<boost::multiprecision::limb_type>>,
    boost::multiprecision::et_off>;

// A finite double as mantissa * 2^exponent, exactly. The mantissa is odd; 0 is 0 * 2^0.
struct Binary {
  std::int64_t mantissa = 0;
  int exponent = 0;
};
Binary binary_of(double value);

// Sets out[i] to the integer values[i] * 2^-e, with one e for all: the least exponent of their
// binary forms. Scaling all coordinates of a query by one positive number changes no sign and no
// root.
void to_common_integers(std::span<const double> values, std::span<Integer> out);

// The exact time mantissa * 2^exponent.
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
  // Returns the polynomial value_t0 + t (value_t1 - value_t0).
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
  // Returns a positive multiple of f(lo + s (hi - lo)) as a polynomial in s. REQUIRES lo < hi.
  Polynomial over(const Dyadic& lo, const Dyadic& hi) const;

  // Returns the exact sign (-1, 0, 1) at a time. 0.1 us, unless the terms cancel almost completely
  // at that time (ball.h).
  int sign_at(const Dyadic& time) const;
  // Return the exact signs at t = 0 and t = 1, without a Dyadic.
  int sign_at_zero() const;
  int sign_at_one() const;

  // Divides all coefficients by `divisor`. REQUIRES that `divisor` divides every coefficient.
  void divide_exactly(const Integer& divisor);
  // Divides all coefficients by the greatest power of two that divides every coefficient.
  void take_out_powers_of_two();
  // Returns the pseudo-remainder by `divisor`: the remainder of this polynomial times |leading
  // coefficient of divisor|^(difference of degrees + 1). If the degree of this polynomial is lower
  // than that of `divisor`, the result is this polynomial itself. REQUIRES that `divisor` is not
  // zero.
  Polynomial remainder(const Polynomial& divisor) const;
  // Returns this polynomial divided by `divisor`, up to a non-zero constant factor. REQUIRES that
  // `divisor` divides this polynomial up to a constant. The integers of the result are at most some
  // bits longer than the integers of this polynomial.
  Polynomial quotient(const Polynomial& divisor) const;

  static constexpr std::size_t inline_coefficients = 7;

 private:
  void trim();
  // By ascending powers; the last coefficient is not zero.
  boost::container::small_vector<Integer, inline_coefficients> coefficients_;
};

// Makes the multiple roots of a polynomial simple. This is done before its roots are isolated.
//
// Returns a polynomial with the same distinct roots as f (complex ones too), each of them simple.
// The result can differ from the square-free part of f by a constant factor. REQUIRES that f is not
// zero. 1 us if f has no multiple root.
Polynomial square_free_part(const Polynomial& f);

}  // namespace assay::detector
