// Signs that all numbers of an interval (a type with inf() and sup()) surely have; polynomials on
// pieces of the step; and intervals that need no change of the rounding mode.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "detector/mesh/types.h"

namespace assay::oracle {

// Returns 1 or -1 when every number of the interval has that sign; 0 when that is not certain.
template <class Interval>
int sure_sign(const Interval& x) {
  if (x.inf() > 0) return 1;
  return x.sup() < 0 ? -1 : 0;
}

// Returns 1 or -1 when all coefficients, and so the polynomial on its piece, surely have that sign;
// 0 when that is not certain.
template <class Interval, std::size_t N>
int sure_sign(const std::array<Interval, N>& coefficients) {
  const int sign = sure_sign(coefficients[0]);
  for (std::size_t k = 1; k < N && sign != 0; ++k) {
    if (sure_sign(coefficients[k]) != sign) return 0;
  }
  return sign;
}

// Returns whether every coordinate of the moving points is less than `bound` in magnitude at t=0
// and at t=1.
template <class Points>
bool all_coordinates_below(const Points& points, double bound) {
  for (const auto& p : points) {
    for (int k = 0; k < 3; ++k) {
      if (!(std::fabs(p.t0[k]) < bound) || !(std::fabs(p.t1[k]) < bound)) return false;
    }
  }
  return true;
}

// Polynomials on a piece [s,e] of the step, in scaled Bernstein form, over any number type.
//
// With w = (t - s)/(e - s), c_k is the coefficient of (1-w)^(n-k) w^k, without the binomial, so
// that products are plain convolutions. These basis functions are >= 0 on the piece, and at no
// point are all of them 0. So if all coefficients have one strict sign, the polynomial has that
// sign on the whole (closed) piece. The first and last coefficients are the values at s and e.

template <class Number, std::size_t Degree>
using Bernstein = std::array<Number, Degree + 1>;

template <class Number>
using Vector3 = std::array<Number, 3>;

// A vector whose coordinates are linear on the piece.
template <class Number>
struct LinearVector {
  Vector3<Number> s, e;
};

// The difference of two moving points, stored for t=0 and for t=1.
template <class Number>
class MovingDifference {
 public:
  MovingDifference(const detector::MovingPoint& from, const detector::MovingPoint& to) {
    for (int k = 0; k < 3; ++k) {
      t0_[k] = Number(to.t0[k]) - Number(from.t0[k]);
      t1_[k] = Number(to.t1[k]) - Number(from.t1[k]);
    }
  }
  LinearVector<Number> on(double s, double e) const { return {at(s), at(e)}; }

 private:
  Vector3<Number> at(double t) const {
    if (t == 0) return t0_;
    if (t == 1) return t1_;
    Vector3<Number> u;
    for (int k = 0; k < 3; ++k) u[k] = Number(1 - t) * t0_[k] + Number(t) * t1_[k];
    return u;
  }
  Vector3<Number> t0_, t1_;
};

// The piece [s,e] of the step, made by cutting the step `depth` times.
struct StepPiece {
  double s = 0, e = 1;
  int depth = 0;
};

// The pieces of the step that wait to be judged, the earliest first; the first piece is the whole
// step. A piece is cut beside its middle, because contacts at 1/2, 1/4, ... are frequent in made-up
// input, and intervals cannot decide a sign at a zero that lies on a bound of a piece. Each cut
// adds 5 bits to the bounds of a piece. So up to a depth of 9, a bound and 1 minus the bound are
// exact doubles.
template <int most_depth>
class StepPieces {
 public:
  bool empty() const { return size_ == 0; }
  StepPiece take() { return stack_[--size_]; }
  void cut(const StepPiece& piece) {
    const double middle = piece.s + (piece.e - piece.s) * (15.0 / 32.0);
    stack_[size_++] = {middle, piece.e, piece.depth + 1};
    stack_[size_++] = {piece.s, middle, piece.depth + 1};
  }

 private:
  std::array<StepPiece, most_depth + 2> stack_;  // later pieces below earlier ones
  int size_ = 1;
};

// A vector whose coordinates are quadratic on the piece: coefficients by axis.
template <class Number>
using QuadraticVector = std::array<Bernstein<Number, 2>, 3>;

template <class Number, std::size_t M, std::size_t N>
std::array<Number, M + N - 1> product(const std::array<Number, M>& a,
                                      const std::array<Number, N>& b) {
  std::array<Number, M + N - 1> c;
  for (std::size_t k = 0; k < M + N - 1; ++k) {
    const std::size_t first = k < N ? 0 : k - N + 1;
    const std::size_t last = k < M ? k : M - 1;
    c[k] = a[first] * b[k - first];
    for (std::size_t i = first + 1; i <= last; ++i) c[k] = c[k] + a[i] * b[k - i];
  }
  return c;
}

template <class Number, std::size_t N>
std::array<Number, N> sum(const std::array<Number, N>& a, const std::array<Number, N>& b) {
  std::array<Number, N> c;
  for (std::size_t k = 0; k < N; ++k) c[k] = a[k] + b[k];
  return c;
}

template <class Number, std::size_t N>
std::array<Number, N> difference(const std::array<Number, N>& a, const std::array<Number, N>& b) {
  std::array<Number, N> c;
  for (std::size_t k = 0; k < N; ++k) c[k] = a[k] - b[k];
  return c;
}

template <class Number>
QuadraticVector<Number> cross(const LinearVector<Number>& u, const LinearVector<Number>& v) {
  QuadraticVector<Number> w;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    w[k] = {u.s[i] * v.s[j] - u.s[j] * v.s[i],
            (u.s[i] * v.e[j] - u.s[j] * v.e[i]) + (u.e[i] * v.s[j] - u.e[j] * v.s[i]),
            u.e[i] * v.e[j] - u.e[j] * v.e[i]};
  }
  return w;
}

template <class Number>
Bernstein<Number, 3> dot(const LinearVector<Number>& u, const QuadraticVector<Number>& w) {
  auto term = [&](int k) { return product(Bernstein<Number, 1>{u.s[k], u.e[k]}, w[k]); };
  return sum(sum(term(0), term(1)), term(2));
}

template <class Number>
Bernstein<Number, 2> dot(const LinearVector<Number>& u, const LinearVector<Number>& v) {
  auto term = [&](int k) {
    return product(Bernstein<Number, 1>{u.s[k], u.e[k]}, Bernstein<Number, 1>{v.s[k], v.e[k]});
  };
  return sum(sum(term(0), term(1)), term(2));
}

// Intervals of doubles that hold exact results and need no change of the rounding mode.
//
// A result r, rounded to nearest, differs from the exact result by at most 2^-53 |r| or, if r is
// denormal, by at most half of the least double. The result is widened by `slack(r)` = 2^-52 |r|
// plus the least double. This is more than twice the error of r. The excess covers the rounding of
// the widening itself, which is at most half a unit in the last place of r or of its neighbour.
// REQUIRES rounding to nearest, denormals that are not flushed, and results below the greatest
// double.
struct Enclosure {
  double lo = 0, hi = 0;

  Enclosure() = default;
  explicit Enclosure(double x) : lo(x), hi(x) {}
  // `least` and `greatest` are two exact results after rounding. Holds both exact results and all
  // numbers between them.
  Enclosure(double least, double greatest)
      : lo(least - slack(least)), hi(greatest + slack(greatest)) {}

  static double slack(double r) {
    return std::fabs(r) * 0x1p-52 + std::numeric_limits<double>::denorm_min();
  }
};

inline Enclosure operator+(const Enclosure& a, const Enclosure& b) {
  return {a.lo + b.lo, a.hi + b.hi};
}
inline Enclosure operator-(const Enclosure& a, const Enclosure& b) {
  return {a.lo - b.hi, a.hi - b.lo};
}
inline Enclosure operator*(double s, const Enclosure& a) {
  return s < 0 ? Enclosure{s * a.hi, s * a.lo} : Enclosure{s * a.lo, s * a.hi};
}
inline Enclosure square(const Enclosure& a) {
  const double x = a.lo * a.lo, y = a.hi * a.hi;
  if (a.lo > 0 || a.hi < 0) return {std::min(x, y), std::max(x, y)};
  Enclosure result{0, std::max(x, y)};
  result.lo = 0;
  return result;
}

}  // namespace assay::oracle
