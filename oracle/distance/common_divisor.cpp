#include "oracle/distance/common_divisor.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace assay::oracle {

namespace {

void trim(IntegerPolynomial& p) {
  while (!p.c.empty() && sgn(p.c.back()) == 0) p.c.pop_back();
}

void divide_exactly(IntegerPolynomial& p, const Integer& divisor) {
  if (divisor == 1) return;
  for (Integer& x : p.c) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), divisor.get_mpz_t());
}

void make_primitive(IntegerPolynomial& p) {
  Integer common = 0;
  for (const Integer& x : p.c) {
    common = gcd(common, x);
    if (common == 1) return;
  }
  if (common != 0) divide_exactly(p, common);
}

// t = numerator / 2^shift.
struct Dyadic {
  explicit Dyadic(double t) {
    if (t == 0) return;
    int exponent = 0;
    const double fraction = std::frexp(t, &exponent);
    constexpr int digits = std::numeric_limits<double>::digits;
    numerator = std::ldexp(fraction, digits);
    shift = digits - exponent;
    const auto zeros = std::min(static_cast<int>(mpz_scan1(numerator.get_mpz_t(), 0)), shift);
    numerator >>= static_cast<mp_bitcnt_t>(zeros);
    shift -= zeros;
  }
  Integer numerator = 0;
  int shift = 0;
};

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

// Euclid's algorithm.
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

// p divided by `divisor`; nothing if it is none over the integers.
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

// By remainders modulo small primes (Brown). Modulo a prime that divides neither leading
// coefficient the divisor has at least its degree, and with few exceptions just that. Scaled to
// have the leading coefficient of p, which that of the divisor divides (Gauss), its coefficients
// are put together by the Chinese remainder theorem, until one more prime changes nothing and it
// divides both. Numbers stay as short as those of p: for long ones GMP would take much of a small
// stack.
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
      const Residue wanted = common[i] * scale % prime;
      const Residue by = (wanted + prime - residue(x, prime)) % prime * per_modulus % prime;
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
  const Dyadic from(lo), to(hi);
  const int shift = std::max(from.shift, to.shift);
  const auto scaled = [&](const Dyadic& t) {
    return Integer(t.numerator << static_cast<mp_bitcnt_t>(shift - t.shift));
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
  IntegerPolynomial result{std::move(r)};
  trim(result);
  mp_bitcnt_t common = std::numeric_limits<mp_bitcnt_t>::max();
  for (const Integer& x : result.c) {
    if (sgn(x) != 0) common = std::min(common, mpz_scan1(x.get_mpz_t(), 0));
  }
  for (Integer& x : result.c) x >>= common;
  return result;
}

}  // namespace assay::oracle
