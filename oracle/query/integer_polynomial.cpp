#include "oracle/query/integer_polynomial.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace assay::oracle {

namespace {

IntegerPolynomial trimmed(std::vector<Integer> c) {
  while (!c.empty() && sgn(c.back()) == 0) c.pop_back();
  return {std::move(c)};
}

}  // namespace

IntegerPolynomial operator+(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  std::vector<Integer> c(std::max(a.c.size(), b.c.size()));
  for (std::size_t i = 0; i < a.c.size(); ++i) c[i] = a.c[i];
  for (std::size_t i = 0; i < b.c.size(); ++i) c[i] += b.c[i];
  return trimmed(std::move(c));
}

IntegerPolynomial operator-(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  std::vector<Integer> c(std::max(a.c.size(), b.c.size()));
  for (std::size_t i = 0; i < a.c.size(); ++i) c[i] = a.c[i];
  for (std::size_t i = 0; i < b.c.size(); ++i) c[i] -= b.c[i];
  return trimmed(std::move(c));
}

IntegerPolynomial operator-(const IntegerPolynomial& a) { return IntegerPolynomial{} - a; }

IntegerPolynomial operator*(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<Integer> c(a.c.size() + b.c.size() - 1);
  for (std::size_t i = 0; i < a.c.size(); ++i) {
    for (std::size_t j = 0; j < b.c.size(); ++j) {
      mpz_addmul(c[i + j].get_mpz_t(), a.c[i].get_mpz_t(), b.c[j].get_mpz_t());
    }
  }
  return trimmed(std::move(c));
}

IntegerPolynomial linear(const Integer& at_t0, const Integer& at_t1) {
  return trimmed({at_t0, at_t1 - at_t0});
}

IntegerPolynomial derivative(const IntegerPolynomial& p) {
  IntegerPolynomial d;
  for (std::size_t k = 1; k < p.c.size(); ++k) d.c.push_back(p.c[k] * static_cast<unsigned>(k));
  return d;
}

int sign_at(const IntegerPolynomial& p, double t) {
  if (p.is_zero()) return 0;
  if (t == 0) return sgn(p.c.front());
  // t = m * 2^exponent with an odd integer m; Horner on 2^(-exponent * degree) p(t).
  int exponent = 0;
  const double mantissa = std::frexp(t, &exponent);
  Integer m(std::ldexp(mantissa, std::numeric_limits<double>::digits));
  exponent -= std::numeric_limits<double>::digits;
  const auto zeros = mpz_scan1(m.get_mpz_t(), 0);
  m >>= zeros;
  exponent += static_cast<int>(zeros);

  Integer value = p.c.back();
  Integer term;
  const auto step = static_cast<mp_bitcnt_t>(std::abs(exponent));
  for (int i = p.degree() - 1, shift = 1; i >= 0; --i, ++shift) {
    value *= m;
    if (exponent >= 0) {
      value <<= step;
      value += p.c[i];
    } else {
      term = p.c[i] << (step * shift);
      value += term;
    }
  }
  return sgn(value);
}

std::vector<Integer> bernstein_over_unit(const IntegerPolynomial& p) {
  // b_k = sum over i <= k of binomial(n-i, k-i) c_i: the Taylor shift by 1 of the reversed
  // polynomial, by running sums in place.
  std::vector<Integer> b = p.c;
  const int n = p.degree();
  for (int round = 0; round < n; ++round) {
    for (int k = 1; k <= n - round; ++k) b[k] += b[k - 1];
  }
  return b;
}

int sign_changes(const std::vector<Integer>& sequence) {
  int changes = 0, before = 0;
  for (const Integer& x : sequence) {
    const int sign = sgn(x);
    if (sign == 0) continue;
    changes += before * sign < 0;
    before = sign;
  }
  return changes;
}

bool surely_no_zero_in_unit(const IntegerPolynomial& p) {
  if (p.is_zero()) return false;
  const std::vector<Integer> b = bernstein_over_unit(p);
  const int sign = sgn(b[0]);
  return sign != 0 &&
         std::all_of(b.begin(), b.end(), [&](const Integer& x) { return sgn(x) == sign; });
}

namespace {

struct Decomposed {
  double mantissa;  // an odd integer
  int exponent;     // the value is mantissa * 2^exponent
};

Decomposed decompose(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const double digits = std::ldexp(fraction, std::numeric_limits<double>::digits);
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(std::fabs(digits)));
  return {std::ldexp(digits, -zeros), exponent - std::numeric_limits<double>::digits + zeros};
}

}  // namespace

IntegerScale::IntegerScale(std::span<const detector::MovingPoint> points) {
  int least = std::numeric_limits<int>::max();
  auto include = [&](const detector::Point& p) {
    for (double x : p) {
      assert(std::isfinite(x));
      if (x != 0) least = std::min(least, decompose(x).exponent);
    }
  };
  for (const detector::MovingPoint& p : points) {
    include(p.t0);
    include(p.t1);
  }
  if (least != std::numeric_limits<int>::max()) exponent_ = least;
}

Integer IntegerScale::operator()(double coordinate) const {
  if (coordinate == 0) return 0;
  const Decomposed d = decompose(coordinate);
  assert(d.exponent >= exponent_);
  return Integer(d.mantissa) << static_cast<mp_bitcnt_t>(d.exponent - exponent_);
}

PolynomialVector moving_difference(const IntegerScale& scale, const detector::MovingPoint& from,
                                   const detector::MovingPoint& to) {
  PolynomialVector u;
  for (int k = 0; k < 3; ++k) {
    u[k] = linear(scale(to.t0[k]) - scale(from.t0[k]), scale(to.t1[k]) - scale(from.t1[k]));
  }
  return u;
}

PolynomialVector cross(const PolynomialVector& u, const PolynomialVector& v) {
  PolynomialVector w;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    w[k] = u[i] * v[j] - u[j] * v[i];
  }
  return w;
}

IntegerPolynomial dot(const PolynomialVector& u, const PolynomialVector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

}  // namespace assay::oracle
