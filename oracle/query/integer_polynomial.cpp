#include "oracle/query/integer_polynomial.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace assay::oracle {

namespace {

IntegerPolynomial trimmed(std::vector<Integer> c) {
  while (!c.empty() && sgn(c.back()) == 0) c.pop_back();
  return {std::move(c)};
}

struct Decomposed {
  double mantissa;  // an odd integer
  int exponent;     // the value is mantissa * 2^exponent
};

Decomposed decompose(double x) {
  if (x == 0) return {0, 0};
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const double digits = std::ldexp(fraction, std::numeric_limits<double>::digits);
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(std::fabs(digits)));
  return {std::ldexp(digits, -zeros), exponent - std::numeric_limits<double>::digits + zeros};
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

Integer discriminant(const IntegerPolynomial& f) {
  if (f.degree() < 2) return 1;
  const Integer &d = f.c[0], &c = f.c[1], &b = f.c[2];
  if (f.degree() == 2) return c * c - 4 * b * d;
  const Integer& a = f.c[3];
  return b * b * c * c - 4 * a * c * c * c - 4 * b * b * b * d - 27 * a * a * d * d +
         18 * a * b * c * d;
}

int sign_at(const IntegerPolynomial& p, double t) {
  if (p.is_zero()) return 0;
  if (t == 0) return sgn(p.c.front());
  // t = m * 2^exponent with an odd integer m; Horner on 2^(-exponent * degree) p(t).
  const auto [mantissa, exponent] = decompose(t);
  const Integer m(mantissa);
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

namespace {

void make_primitive(IntegerPolynomial& p) {
  Integer common = 0;
  for (const Integer& x : p.c) {
    common = gcd(common, x);
    if (common == 1) return;
  }
  for (Integer& x : p.c) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), common.get_mpz_t());
}

// Polynomials over the integers modulo a prime below 2^31, the highest coefficient last and not
// zero.
using Residue = std::uint64_t;
using Residues = std::vector<Residue>;

Residue residue(const Integer& x, Residue prime) { return mpz_fdiv_ui(x.get_mpz_t(), prime); }

Residues residues(const IntegerPolynomial& p, Residue prime) {
  Residues r;
  r.reserve(p.c.size());
  for (const Integer& x : p.c) r.push_back(residue(x, prime));
  return r;
}

Residue inverse(Residue x, Residue prime) {
  Residue result = 1;  // x^(prime - 2)
  for (Residue exponent = prime - 2; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) result = result * x % prime;
    x = x * x % prime;
  }
  return result;
}

// Finds the divisor by Euclid's algorithm.
Residues common_divisor(Residues u, Residues v, Residue prime) {
  if (u.size() < v.size()) std::swap(u, v);
  while (!v.empty()) {
    const Residue scale = inverse(v.back(), prime);
    while (u.size() >= v.size()) {
      const Residue factor = u.back() * scale % prime;
      const std::size_t shift = u.size() - v.size();
      for (std::size_t i = 0; i < v.size(); ++i) {
        u[shift + i] = (u[shift + i] + (prime - factor) * v[i]) % prime;
      }
      while (!u.empty() && u.back() == 0) u.pop_back();
    }
    std::swap(u, v);
  }
  return u;
}

// Returns p divided by `divisor`; nothing if p has no such divisor over the integers.
std::optional<IntegerPolynomial> divided(const IntegerPolynomial& p,
                                         const IntegerPolynomial& divisor) {
  const int n = divisor.degree();
  if (p.degree() < n) return {};
  IntegerPolynomial result;
  result.c.resize(p.c.size() - divisor.c.size() + 1);
  std::vector<Integer> r = p.c;
  for (int k = p.degree() - n; k >= 0; --k) {
    Integer& share = result.c[k];
    if (mpz_divisible_p(r[k + n].get_mpz_t(), divisor.c.back().get_mpz_t()) == 0) return {};
    mpz_divexact(share.get_mpz_t(), r[k + n].get_mpz_t(), divisor.c.back().get_mpz_t());
    for (int i = 0; i <= n; ++i) r[k + i] -= share * divisor.c[i];
  }
  for (const Integer& x : r) {
    if (sgn(x) != 0) return {};
  }
  return result;
}

}  // namespace

// Works by remainders modulo small primes (Brown). Modulo a prime that divides neither leading
// coefficient, the common divisor has at least its true degree, and with few exceptions exactly
// that. Its leading coefficient divides that of p (Gauss), so it is scaled to the leading
// coefficient of p. The Chinese remainder theorem joins its coefficients, until one more prime
// changes nothing and it divides both. Numbers stay as short as those of p: for long ones GMP would
// take much of a small stack.
IntegerPolynomial common_divisor(const IntegerPolynomial& p, const IntegerPolynomial& q) {
  IntegerPolynomial found;
  Integer modulus = 1, next_prime = Integer(1) << 30;
  for (;;) {
    mpz_nextprime(next_prime.get_mpz_t(), next_prime.get_mpz_t());
    const Residue prime = next_prime.get_ui();
    const Residues u = residues(p, prime), v = residues(q, prime);
    if (u.back() == 0 || v.back() == 0) continue;
    const Residues common = common_divisor(u, v, prime);
    if (common.size() == 1) return {{1}};
    if (!found.is_zero() && common.size() > found.c.size()) continue;
    if (found.is_zero() || common.size() < found.c.size()) {
      found.c.assign(common.size(), 0);
      modulus = 1;
    }
    const Residue scale = u.back() * inverse(common.back(), prime) % prime;
    const Residue per_modulus = inverse(residue(modulus, prime), prime);
    const Integer next_modulus = modulus * next_prime, half = next_modulus >> 1;
    bool stable = modulus != 1;
    for (std::size_t i = 0; i < common.size(); ++i) {
      Integer& x = found.c[i];
      const Residue target = common[i] * scale % prime;
      const Residue by = (target + prime - residue(x, prime)) % prime * per_modulus % prime;
      stable = stable && by == 0;
      mpz_addmul_ui(x.get_mpz_t(), modulus.get_mpz_t(), by);
      if (x > half) x -= next_modulus;
    }
    modulus = next_modulus;
    if (!stable) continue;
    IntegerPolynomial candidate = found;
    make_primitive(candidate);
    if (divided(p, candidate) && divided(q, candidate)) return candidate;
  }
}

IntegerPolynomial quotient(const IntegerPolynomial& p, const IntegerPolynomial& divisor) {
  auto result = divided(p, divisor);
  assert(result);
  return std::move(*result);
}

IntegerPolynomial on_piece(const IntegerPolynomial& p, double lo, double hi) {
  if (p.degree() <= 0 || (lo == 0 && hi == 1)) return p;
  const Decomposed from = decompose(lo), to = decompose(hi);
  const int shift = -std::min(from.exponent, to.exponent);
  const auto scaled = [&](const Decomposed& t) {
    return Integer(Integer(t.mantissa) << static_cast<mp_bitcnt_t>(shift + t.exponent));
  };
  const Integer start = scaled(from), length = scaled(to) - start;
  // Horner: the polynomial of x so far, times start + length x, plus the next coefficient.
  std::vector<Integer> r = {p.c.back()};
  for (int i = p.degree() - 1, powers = 1; i >= 0; --i, ++powers) {
    r.emplace_back(0);
    for (std::size_t k = r.size() - 1; k > 0; --k) {
      r[k] *= start;
      mpz_addmul(r[k].get_mpz_t(), r[k - 1].get_mpz_t(), length.get_mpz_t());
    }
    r[0] *= start;
    r[0] += p.c[i] << static_cast<mp_bitcnt_t>(shift * powers);
  }
  IntegerPolynomial result = trimmed(std::move(r));
  mp_bitcnt_t common = std::numeric_limits<mp_bitcnt_t>::max();
  for (const Integer& x : result.c) {
    if (sgn(x) != 0) common = std::min(common, mpz_scan1(x.get_mpz_t(), 0));
  }
  for (Integer& x : result.c) x >>= common;
  return result;
}

}  // namespace assay::oracle
