// Times whose signs are closed formulas: a zero of a polynomial of degree 1 or 2, as an exact
// number, and the zeros of one cubic in the closed step, between those of its derivative.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/query/integer_polynomial.h"
#include "oracle/query/times/time_enclosure.h"

namespace assay::oracle {

// Held is r = -c/b, or r = (-b -+ sqrt(b^2 - 4ac)) / 2a with a > 0, by its integers and by which of
// the two zeros it is. No root is ever taken, and nothing is isolated or refined.
class QuadraticTime {
 public:
  // Appends the distinct real zeros of p, ascending. REQUIRES degree 1 or 2.
  static void append_zeros(const IntegerPolynomial& p, std::vector<QuadraticTime>& to);

  // The exact sign of q(r). Some 10 products of integers where q has degree 2.
  int sign(const IntegerPolynomial& q) const;
  // The exact sign of r - other.
  int compare(const QuadraticTime& other) const;
  // The exact sign of r - t. REQUIRES 0 <= t <= 1.
  int compare(double t) const;
  // REQUIRES 0 <= r <= 1.
  detector::TimeEnclosure enclosure() const;

 private:
  enum class Zero : signed char { lesser = -1, only = 0, greater = 1 };

  QuadraticTime(Integer a, Integer b, Integer c, Zero zero);
  // The exact sign of u r + v.
  int sign_of_linear(const Integer& u, const Integer& v) const;
  double guess() const;

  Integer a_, b_, c_;  // r is a zero of a t^2 + b t + c; a = 0 and b > 0 if it is the only one
  Zero zero_;
};

// The zeros in the closed step of polynomials of degree 1 and 2, in order.
class QuadraticTimes final : public ExactTimes {
 public:
  // Finds the distinct zeros in [0,1] of all the polynomials together, ascending. A constant has
  // none. REQUIRES that no polynomial is identically zero, and degrees <= 2.
  explicit QuadraticTimes(std::span<const IntegerPolynomial> polynomials);

  int size() const override { return static_cast<int>(times_.size()); }
  int sign(const IntegerPolynomial& q, int i) const override { return times_[i].sign(q); }
  detector::TimeEnclosure enclosure(int i) const override { return times_[i].enclosure(); }
  // Gives the times away.
  std::vector<QuadraticTime> take() { return std::move(times_); }

 private:
  std::vector<QuadraticTime> times_;
};

// On the pieces of the step between the zeros of its derivative a cubic f is strictly monotone. So
// its zeros are some of the bounds of these pieces, and one inside of each piece at whose bounds f
// has opposite signs. A zero is held by its piece. All questions come down to signs of f at zeros
// of quadratics, which are closed formulas; nothing is isolated or refined.
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
    std::size_t bound;    // where it is, or where its piece begins
    bool inside = false;  // of the piece
  };
  // The exact sign of the zero minus another time or a double in [0,1].
  template <class Time>
  int compare(const Zero& zero, const Time& other) const;

  IntegerPolynomial f_;
  std::vector<QuadraticTime> bounds_;  // from 0 to 1
  std::vector<int> signs_;             // of f at the bounds
  std::vector<Zero> zeros_;
};

}  // namespace assay::oracle
