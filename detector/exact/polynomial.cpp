#include "detector/exact/polynomial.h"

#include <bit>
#include <cassert>
#include <climits>
#include <cmath>
#include <limits>

#include "detector/exact/ball.h"
#include "detector/exact/fixed_integer.h"

namespace assay::detector {

Binary binary_of(double value) {
  assert(std::isfinite(value));
  if (value == 0) return {};
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  constexpr int mantissa_bits = 53;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, mantissa_bits));
  exponent -= mantissa_bits;
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  return {mantissa >> zeros, exponent + zeros};
}

void to_common_integers(std::span<const double> values, std::span<Integer> out) {
  assert(values.size() == out.size());
  int least = INT_MAX;
  for (const double value : values) {
    if (value != 0) least = std::min(least, binary_of(value).exponent);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Binary b = binary_of(values[i]);
    out[i] = b.mantissa;
    if (b.mantissa != 0) out[i] <<= static_cast<unsigned>(b.exponent - least);
  }
}

Dyadic Dyadic::of(double time) {
  const Binary b = binary_of(time);
  if (b.exponent > 0) return {Integer(b.mantissa) << static_cast<unsigned>(b.exponent), 0};
  return {b.mantissa, b.exponent};
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  const int least = std::min(a.exponent, b.exponent);
  return {(a.mantissa << static_cast<unsigned>(a.exponent - least)) +
              (b.mantissa << static_cast<unsigned>(b.exponent - least)),
          least};
}

Polynomial Polynomial::constant(const Integer& value) {
  Polynomial p;
  p.coefficients_.push_back(value);
  p.trim();
  return p;
}

Polynomial Polynomial::linear(const Integer& value_t0, const Integer& value_t1) {
  Polynomial p;
  p.coefficients_.push_back(value_t0);
  p.coefficients_.push_back(value_t1 - value_t0);
  p.trim();
  return p;
}

void Polynomial::trim() {
  while (!coefficients_.empty() && coefficients_.back().is_zero()) coefficients_.pop_back();
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  const bool a_longer = a.coefficients_.size() >= b.coefficients_.size();
  Polynomial sum = a_longer ? a : b;
  const Polynomial& other = a_longer ? b : a;
  for (std::size_t i = 0; i < other.coefficients_.size(); ++i) {
    sum.coefficients_[i] += other.coefficients_[i];
  }
  sum.trim();
  return sum;
}

Polynomial Polynomial::operator-() const {
  Polynomial negated = *this;
  for (auto& c : negated.coefficients_) c.backend().negate();
  return negated;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + (-b); }

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product;
  if (a.is_zero() || b.is_zero()) return product;
  product.coefficients_.resize(a.coefficients_.size() + b.coefficients_.size() - 1);
  Integer term;
  for (std::size_t i = 0; i < a.coefficients_.size(); ++i) {
    for (std::size_t j = 0; j < b.coefficients_.size(); ++j) {
      multiply(term, a.coefficients_[i], b.coefficients_[j]);
      product.coefficients_[i + j] += term;
    }
  }
  return product;
}

Polynomial Polynomial::derivative() const {
  Polynomial d;
  for (std::size_t i = 1; i < coefficients_.size(); ++i) {
    d.coefficients_.push_back(coefficients_[i] * static_cast<unsigned>(i));
  }
  return d;
}

// With lo = m 2^-k and hi - lo = w 2^-k, this is f((m + w s) 2^-k) 2^(k degree), in integers.
Polynomial Polynomial::over(const Dyadic& lo, const Dyadic& hi) const {
  assert(lo.exponent <= 0 && hi.exponent <= 0);
  const int k = -std::min(lo.exponent, hi.exponent);
  const Integer begin = lo.mantissa << static_cast<unsigned>(lo.exponent + k);
  const Integer width = (hi.mantissa << static_cast<unsigned>(hi.exponent + k)) - begin;
  assert(width.sign() > 0);
  Polynomial p = *this;
  auto& c = p.coefficients_;
  const std::size_t count = c.size();
  for (std::size_t i = 0; i < count; ++i) {
    c[i] <<= static_cast<unsigned>(k) * static_cast<unsigned>(count - 1 - i);
  }
  if (!begin.is_zero()) {
    for (std::size_t i = 0; i + 1 < count; ++i) {
      for (std::size_t j = count - 1; j-- > i;) c[j] += begin * c[j + 1];
    }
  }
  const auto width_bits = msb(width);
  if (lsb(width) == width_bits) {
    for (std::size_t i = 1; i < count; ++i) c[i] <<= width_bits * i;
  } else {
    Integer power = width;
    for (std::size_t i = 1; i < count; ++i, power *= width) c[i] *= power;
  }
  p.take_out_powers_of_two();
  return p;
}

int Polynomial::sign_at(const Dyadic& time) const {
  if (is_zero()) return 0;
  assert(time.exponent <= 0);
  if (degree() == 0) return coefficients_.front().sign();
  const Ball t(time.mantissa, time.exponent);
  Ball near(coefficients_.back());
  for (std::size_t i = coefficients_.size() - 1; i-- > 0;) near = near * t + Ball(coefficients_[i]);
  if (const auto sure = near.sign()) return *sure;
  // Horner on sum c_i m^i 2^(e i), multiplied by 2^(-e degree) to stay in integers.
  const auto shift = static_cast<unsigned>(-time.exponent);
  Integer value = coefficients_.back(), term;
  unsigned total = 0;
  for (std::size_t i = coefficients_.size() - 1; i-- > 0;) {
    total += shift;
    value *= time.mantissa;
    term = coefficients_[i];
    term <<= total;
    value += term;
  }
  return value.sign();
}

int Polynomial::sign_at_zero() const { return is_zero() ? 0 : coefficients_.front().sign(); }

int Polynomial::sign_at_one() const {
  Integer sum = 0;
  for (const auto& c : coefficients_) sum += c;
  return sum.sign();
}

void Polynomial::divide_exactly(const Integer& divisor) {
  if (divisor == 1) return;
  for (auto& c : coefficients_) c /= divisor;
}

Polynomial Polynomial::remainder(const Polynomial& divisor) const {
  assert(!divisor.is_zero());
  Polynomial rest = *this;
  const Integer scale = abs(divisor.leading());
  const bool negative = divisor.leading().sign() < 0;
  int steps = degree() - divisor.degree() + 1;
  for (; rest.degree() >= divisor.degree(); --steps) {
    Integer factor = rest.leading();
    if (negative) factor.backend().negate();
    const auto offset = static_cast<std::size_t>(rest.degree() - divisor.degree());
    for (auto& c : rest.coefficients_) c *= scale;
    for (std::size_t i = 0; i < divisor.coefficients_.size(); ++i) {
      rest.coefficients_[offset + i] -= factor * divisor.coefficients_[i];
    }
    rest.trim();
  }
  for (; steps > 0; --steps) {
    for (auto& c : rest.coefficients_) c *= scale;
  }
  return rest;
}

void Polynomial::take_out_powers_of_two() {
  if (is_zero()) return;
  std::size_t common = std::numeric_limits<std::size_t>::max();
  for (const auto& c : coefficients_) {
    if (!c.is_zero()) common = std::min<std::size_t>(common, lsb(abs(c)));
  }
  if (common == 0) return;
  for (auto& c : coefficients_) c >>= common;
}

// Let d be the divisor after its integers were freed of common factors. Then this polynomial is d
// h, where h has integer coefficients too (Gauss's lemma). Divided by d / leading(d) instead, it
// gives leading(d) h, which has integer coefficients again. So each h_k d_i below is an integer,
// and it can be written with the coefficients of any multiple of d.
Polynomial Polynomial::quotient(const Polynomial& divisor) const {
  assert(!divisor.is_zero());
  Polynomial rest = *this, result;
  if (degree() < divisor.degree()) return result;
  result.coefficients_.resize(static_cast<std::size_t>(degree() - divisor.degree()) + 1);
  while (rest.degree() >= divisor.degree()) {
    const Integer factor = rest.leading();
    const auto offset = static_cast<std::size_t>(rest.degree() - divisor.degree());
    result.coefficients_[offset] = factor;
    for (std::size_t i = 0; i < divisor.coefficients_.size(); ++i) {
      rest.coefficients_[offset + i] -= factor * divisor.coefficients_[i] / divisor.leading();
    }
    rest.trim();
  }
  assert(rest.is_zero());
  result.take_out_powers_of_two();
  return result;
}

// Most polynomials have simple roots only, and computing modulo one prime shows it. Take a common
// divisor of f and f' with integer coefficients that have no common factor. Its leading
// coefficient divides that of f. So if the prime does not divide the leading coefficient of f, the
// divisor keeps its degree modulo the prime, and is a common divisor there. If there is no common
// divisor of degree 1 or more modulo the prime, there is none at all. If there is one, integers
// decide.

namespace {

constexpr std::uint64_t prime = (std::uint64_t{1} << 61) - 1;

// Returns the value modulo the prime, for which 2^61 is 1.
std::uint64_t reduced(DoubleLimb value) {
  value = (value & prime) + (value >> 61);
  value = (value & prime) + (value >> 61);
  const auto rest = static_cast<std::uint64_t>(value);
  return rest >= prime ? rest - prime : rest;
}

std::uint64_t residue(const Integer& value) {
  const auto& backend = value.backend();
  std::uint64_t rest = 0;
  for (std::size_t i = backend.size(); i-- > 0;) {
    rest = reduced((DoubleLimb{rest} << 64) + backend.limbs()[i]);
  }
  return backend.sign() && rest != 0 ? prime - rest : rest;
}

using Residues = boost::container::small_vector<std::uint64_t, Polynomial::inline_coefficients>;

void trim(Residues& f) {
  while (!f.empty() && f.back() == 0) f.pop_back();
}

// Replaces a by leading(b) a - leading(a) t^k b until its degree is below that of b.
void reduce_by(Residues& a, const Residues& b) {
  while (a.size() >= b.size()) {
    const std::uint64_t of_a = b.back(), of_b = prime - a.back();
    const std::size_t offset = a.size() - b.size();
    for (auto& c : a) c = reduced(DoubleLimb{c} * of_a);
    for (std::size_t i = 0; i < b.size(); ++i) {
      a[offset + i] = reduced(DoubleLimb{b[i]} * of_b + a[offset + i]);
    }
    trim(a);
  }
}

bool surely_square_free(const Polynomial& f) {
  Residues a, b;
  for (int i = 0; i <= f.degree(); ++i) a.push_back(residue(f[i]));
  if (a.back() == 0) return false;
  for (std::size_t i = 1; i < a.size(); ++i) b.push_back(reduced(DoubleLimb{a[i]} * i));
  trim(b);
  while (!b.empty()) {
    reduce_by(a, b);
    std::swap(a, b);
  }
  return a.size() <= 1;
}

// Returns the last subresultant of a and b that is not zero (Collins; Cohen, A Course in
// Computational Algebraic Number Theory, Algorithm 3.3.1). Each pseudo-remainder is divided by a
// factor that is known to divide it. So the coefficients grow by a constant length in each step, as
// determinants of coefficients do, and no greatest common divisor of integers has to be found.
Polynomial common_divisor(Polynomial a, Polynomial b) {
  Integer g = 1, h = 1;
  while (true) {
    const auto step = static_cast<unsigned>(a.degree() - b.degree());
    Polynomial next = a.remainder(b);
    if (next.is_zero()) return b;
    if (next.degree() == 0) return next;
    next.divide_exactly(g * pow(h, step));
    a = std::move(b);
    b = std::move(next);
    g = abs(a.leading());
    // g^step h^(1-step), an integer.
    if (step > 0) h = pow(g, step) / pow(h, step - 1);
  }
}

}  // namespace

Polynomial square_free_part(const Polynomial& f) {
  assert(!f.is_zero());
  if (f.degree() <= 1 || surely_square_free(f)) return f;
  const Polynomial common = common_divisor(f, f.derivative());
  return common.degree() > 0 ? f.quotient(common) : f;
}

}  // namespace assay::detector
