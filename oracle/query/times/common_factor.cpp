#include "oracle/query/times/common_factor.h"

#include <cassert>
#include <utility>

namespace assay::oracle {

namespace {

void make_primitive(IntegerPolynomial& p) {
  Integer content;
  for (const Integer& x : p.c) mpz_gcd(content.get_mpz_t(), content.get_mpz_t(), x.get_mpz_t());
  if (content <= 1) return;
  for (Integer& x : p.c) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), content.get_mpz_t());
}

// lc(b)^k a = quotient b + remainder, degree of the remainder < degree of b.
struct Division {
  IntegerPolynomial quotient, remainder;
};

Division divide(IntegerPolynomial a, const IntegerPolynomial& b) {
  const Integer& leading = b.c.back();
  IntegerPolynomial quotient;
  while (a.degree() >= b.degree()) {
    const Integer top = a.c.back();
    IntegerPolynomial term;  // top t^shift
    term.c.resize(a.c.size() - b.c.size() + 1);
    term.c.back() = top;
    const IntegerPolynomial scale = {{leading}};
    quotient = quotient * scale + term;
    a = a * scale - b * term;
  }
  return {std::move(quotient), std::move(a)};
}

}  // namespace

IntegerPolynomial common_factor(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  assert(!a.is_zero() && !b.is_zero());
  IntegerPolynomial p = a, q = b;
  while (!q.is_zero()) {
    IntegerPolynomial rest = divide(std::move(p), q).remainder;
    make_primitive(rest);
    p = std::move(q);
    q = std::move(rest);
  }
  make_primitive(p);
  return p;
}

IntegerPolynomial cofactor(const IntegerPolynomial& a, const IntegerPolynomial& factor) {
  Division d = divide(a, factor);
  assert(d.remainder.is_zero());
  make_primitive(d.quotient);
  return std::move(d.quotient);
}

}  // namespace assay::oracle
