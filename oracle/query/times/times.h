// Times of the closed step as exact numbers, in each of their representations, and the doubles that
// enclose them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

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
  // Returns the exact sign of q at the i-th time.
  virtual int sign(const IntegerPolynomial& q, int i) const = 0;
  virtual detector::TimeEnclosure enclosure(int i) const = 0;
};

// Returns the canonical enclosure of a time in [lo,hi] that is known only by comparisons with
// doubles. REQUIRES 0 <= lo <= hi, and that compare(t) is the exact sign of (time - t) for doubles
// t in [lo,hi]. A wrong guess costs only work: about 2 log2 n comparisons if the guess is n units
// in the last place away from the time.
template <class Compare>
detector::TimeEnclosure enclose_time(double guess, double lo, double hi, Compare compare) {
  // Doubles >= 0 have the same order as their bit patterns.
  auto bits = [](double t) { return std::bit_cast<std::uint64_t>(t); };
  auto value = [](std::uint64_t b) { return std::bit_cast<double>(b); };
  const std::uint64_t least = bits(lo + 0.0), greatest = bits(hi + 0.0);  // no -0
  if (!(guess > lo)) guess = lo;
  if (guess > hi) guess = hi;

  std::uint64_t at = bits(guess + 0.0);
  const int first = compare(value(at));
  if (first == 0) return {value(at), value(at)};
  // Doubles `step` until `at` has passed the time; then halves the interval.
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

// Guesses a zero of f in [s,e] in plain doubles, without an error bound. REQUIRES a degree of at
// most 6 and opposite signs of f at s and e; `sign_at_s` is the sign at s.
double guess_zero(const IntegerPolynomial& f, double s, double e, int sign_at_s);

// Encloses the zero of f in (s,e) by exact integer signs of f at doubles, without the algebraic
// kernel. REQUIRES that f is of degree 6 at most, that it has exactly one zero in (s,e), a simple
// one, and opposite signs at s and e, and that 0 <= s < e <= 1. 1 to 3 us.
detector::TimeEnclosure simple_zero_time(const IntegerPolynomial& f, double s, double e);

// Times at which closed formulas give the sign of a polynomial: a zero of a polynomial of degree 1
// or 2, as an exact number; and the zeros of one cubic in the closed step, each between zeros of
// its derivative.

// The time is r = -c/b, or r = (-b -+ sqrt(b^2 - 4ac)) / 2a with a > 0. It is stored as the
// integers a, b, c and the choice between the two zeros. No square root is ever computed, and no
// zero is isolated or refined.
class QuadraticTime {
 public:
  // Appends the distinct real zeros of p, ascending. REQUIRES degree 1 or 2.
  static void append_zeros(const IntegerPolynomial& p, std::vector<QuadraticTime>& to);

  // Returns the exact sign of q(r). Takes some 10 products of integers if q has degree 2.
  int sign(const IntegerPolynomial& q) const;
  // Returns the exact sign of r - other.
  int compare(const QuadraticTime& other) const;
  // Returns the exact sign of r - t. REQUIRES 0 <= t <= 1.
  int compare(double t) const;
  // REQUIRES 0 <= r <= 1.
  detector::TimeEnclosure enclosure() const;

 private:
  enum class Zero : signed char { lesser = -1, only = 0, greater = 1 };

  QuadraticTime(Integer a, Integer b, Integer c, Zero zero);
  // Returns the exact sign of u r + v.
  int sign_of_linear(const Integer& u, const Integer& v) const;
  double guess() const;

  Integer a_, b_, c_;  // r is a zero of a t^2 + b t + c; if it is the only zero, a = 0 and b > 0
  Zero zero_;
};

// The zeros in the closed step of polynomials of degree 1 and 2, in order.
class QuadraticTimes final : public ExactTimes {
 public:
  // Finds the distinct zeros in [0,1] of all the polynomials together, ascending. A constant has no
  // zeros. REQUIRES that no polynomial is identically zero, and degrees <= 2.
  explicit QuadraticTimes(std::span<const IntegerPolynomial> polynomials);

  int size() const override { return static_cast<int>(times_.size()); }
  int sign(const IntegerPolynomial& q, int i) const override { return times_[i].sign(q); }
  detector::TimeEnclosure enclosure(int i) const override { return times_[i].enclosure(); }
  // Moves the times out of this object.
  std::vector<QuadraticTime> take() { return std::move(times_); }

 private:
  std::vector<QuadraticTime> times_;
};

// The zeros of a cubic f in the closed step. The zeros of its derivative cut the step into pieces,
// and f is strictly monotone on each piece. So a zero of f either is a bound of a piece, or is the
// only zero inside a piece at whose bounds f has opposite signs. A zero is stored as the number of
// its bound or piece. All signs come from signs of f at zeros of quadratics, which have closed
// formulas; no zero is isolated or refined.
class CubicTimes final : public ExactTimes {
 public:
  // REQUIRES degree 2 or 3.
  explicit CubicTimes(IntegerPolynomial f);

  int size() const override { return static_cast<int>(zeros_.size()); }
  // REQUIRES degree <= 2.
  int sign(const IntegerPolynomial& q, int i) const override;
  detector::TimeEnclosure enclosure(int i) const override;

 private:
  struct Zero {
    std::size_t bound;    // the zero is here, or its piece begins here
    bool inside = false;  // the zero is inside the piece
  };
  // Returns the exact sign of the zero minus another time or a double in [0,1].
  template <class Time>
  int compare(const Zero& zero, const Time& other) const;

  IntegerPolynomial f_;
  std::vector<QuadraticTime> bounds_;  // of the pieces, from 0 to 1
  std::vector<int> signs_;             // of f at the bounds
  std::vector<Zero> zeros_;
};

// The zeros of polynomials in the closed step as exact algebraic numbers, by CGAL's algebraic
// kernel.
//
// This header does not show the kernel. The kernel's numbers are reference counted without regard
// to threads, so an AlgebraicTimes belongs to the thread that made it.

class AlgebraicTimes final : public ExactTimes {
 public:
  // Finds the distinct zeros in [0,1] of all the polynomials together, ascending. REQUIRES that no
  // polynomial is identically zero.
  explicit AlgebraicTimes(std::span<const IntegerPolynomial> polynomials);
  ~AlgebraicTimes() override;

  int size() const override;
  int sign(const IntegerPolynomial& q, int i) const override;
  detector::TimeEnclosure enclosure(int i) const override;

 private:
  struct Zeros;
  std::unique_ptr<Zeros> zeros_;
};

}  // namespace assay::oracle
