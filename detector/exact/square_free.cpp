// Most polynomials have simple roots only, and computing modulo one prime shows it. Take a common
// divisor of f and f' with integer coefficients that have no common factor. Its leading
// coefficient divides that of f. So if the prime does not divide the leading coefficient of f, the
// divisor keeps its degree modulo the prime, and is a common divisor there. If there is no common
// divisor of degree 1 or more modulo the prime, there is none at all. If there is one, integers
// decide.
#include "detector/exact/square_free.h"

#include <cassert>

#include "detector/exact/fixed_integer.h"

namespace assay::detector {
namespace {

constexpr std::uint64_t prime = (std::uint64_t{1} << 61) - 1;

// 2^61 is 1 modulo the prime.
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

// leading(b) a - leading(a) t^k b, until the degree is below that of b.
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

// The last subresultant of a and b that is not zero (Collins; Cohen, A Course in Computational
// Algebraic Number Theory, Algorithm 3.3.1). Each pseudo-remainder is divided by a factor that is
// known to divide it. So the coefficients grow by a constant length in each step, as determinants
// of coefficients do, and no greatest common divisor of integers has to be found.
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
