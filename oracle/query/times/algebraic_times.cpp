// The kernel's own isolation of zeros (Descartes' rule) calls itself for each halving: 1,190 calls
// deep, on half a megabyte of stack, if two zeros agree in that many bits. So this file isolates
// zeros itself, and keeps the remaining pieces on the heap. The kernel still computes square-free
// parts, and compares and refines numbers, all in loops.
#include "oracle/query/times/times.h"

// When two handles of CGAL that share a number are swapped, g++ 12 wrongly sees a use after free.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuse-after-free"
#endif
#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <mpfr.h>

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace assay::oracle {

namespace {

using Kernel = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;
using Polynomial = Kernel::Polynomial_1;
using Real = Kernel::Algebraic_real_1;
using Bound = Kernel::Bound;

Polynomial kernel_polynomial(const IntegerPolynomial& p) {
  std::vector<CGAL::Gmpz> c;
  c.reserve(p.c.size());
  for (const Integer& x : p.c) c.emplace_back(x.get_mpz_t());
  return Polynomial(c.begin(), c.end());
}

Integer integer(const CGAL::Gmpz& x) { return Integer(x.mpz()); }

// Returns the square-free part.
IntegerPolynomial without_multiple_zeros(const Kernel& kernel, const IntegerPolynomial& p) {
  const Polynomial simple = kernel.make_square_free_1_object()(kernel_polynomial(p));
  IntegerPolynomial result;
  for (int i = 0; i <= simple.degree(); ++i) result.c.push_back(integer(simple[i]));
  return result;
}

// Returns k / 2^depth.
Bound dyadic(const Integer& k, unsigned depth) {
  const Integer denominator = Integer(1) << depth;
  return {CGAL::Gmpz(k.get_mpz_t()), CGAL::Gmpz(denominator.get_mpz_t())};
}

// p over the piece of the step from k / 2^depth on, of length 2^-depth, as a polynomial of w in
// [0,1], times a positive power of two.
struct Piece {
  IntegerPolynomial p;
  Integer k;
  unsigned depth;

  Piece lower_half() const {
    Piece half = {p, k * 2, depth + 1};
    for (int i = 0; i < p.degree(); ++i) half.p.c[i] <<= static_cast<unsigned>(p.degree() - i);
    return half;
  }
  // Returns p(w + 1).
  Piece next() const {
    Piece after = {p, k + 1, depth};
    const int n = p.degree();
    for (int round = 0; round < n; ++round) {
      for (int i = n - 1; i >= round; --i) after.p.c[i] += after.p.c[i + 1];
    }
    return after;
  }
};

// Appends the zeros of p in [0,1]. REQUIRES p square-free; then pieces with more than one change of
// signs end where they are short enough (Vincent, Obreschkoff).
void append_zeros(const IntegerPolynomial& p, std::vector<Real>& times) {
  const Polynomial defining = kernel_polynomial(p);
  const auto add_where_zero = [&times](const Piece& piece) {
    if (piece.p.c[0] == 0) times.emplace_back(dyadic(piece.k, piece.depth));
  };
  std::vector<Piece> left = {{p, 0, 0}};
  add_where_zero(left[0]);
  add_where_zero(left[0].next());
  while (!left.empty()) {
    const Piece piece = std::move(left.back());
    left.pop_back();
    const std::vector<Integer> b = bernstein_over_unit(piece.p);
    const int changes = sign_changes(b);
    if (changes == 0) continue;
    // The kernel wants no zero where a piece ends.
    if (changes == 1 && b.front() != 0 && b.back() != 0) {
      times.emplace_back(defining, dyadic(piece.k, piece.depth), dyadic(piece.k + 1, piece.depth));
      continue;
    }
    Piece lower = piece.lower_half();
    Piece upper = lower.next();
    add_where_zero(upper);
    left.push_back(std::move(upper));
    left.push_back(std::move(lower));
  }
}

// Returns q as a polynomial of w, where time = low + w (high - low) on the interval that isolates
// `number`, times a positive power of the denominators.
IntegerPolynomial on_interval(const IntegerPolynomial& q, const Real& number) {
  const Bound low = number.low(), high = number.high();
  const Integer denominator = integer(low.denominator()) * integer(high.denominator());
  const IntegerPolynomial numerator =
      linear(integer(low.numerator()) * integer(high.denominator()),
             integer(high.numerator()) * integer(low.denominator()));
  IntegerPolynomial result;
  Integer power = 1;
  for (auto c = q.c.rbegin(); c != q.c.rend(); ++c) {
    const Integer term = *c * power;
    result = result * numerator + linear(term, term);
    power *= denominator;
  }
  return result;
}

// MPFR keeps a pool of numbers for each thread and never frees it by itself.
struct ThreadCaches {
  ~ThreadCaches() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
};

}  // namespace

struct AlgebraicTimes::Zeros {
  Kernel kernel;
  std::vector<Real> times;
};

AlgebraicTimes::AlgebraicTimes(std::span<const IntegerPolynomial> polynomials)
    : zeros_(std::make_unique<Zeros>()) {
  static thread_local const ThreadCaches freed_when_the_thread_ends;
  const auto compare = zeros_->kernel.compare_1_object();
  std::vector<Real>& times = zeros_->times;
  for (const IntegerPolynomial& p : polynomials) {
    assert(!p.is_zero());
    if (surely_no_zero_in_unit(p)) continue;
    append_zeros(without_multiple_zeros(zeros_->kernel, p), times);
  }
  std::sort(times.begin(), times.end(),
            [&](const Real& a, const Real& b) { return compare(a, b) == CGAL::SMALLER; });
  times.erase(
      std::unique(times.begin(), times.end(),
                  [&](const Real& a, const Real& b) { return compare(a, b) == CGAL::EQUAL; }),
      times.end());
}

AlgebraicTimes::~AlgebraicTimes() = default;

int AlgebraicTimes::size() const { return static_cast<int>(zeros_->times.size()); }

// Does not use the kernel's Sign_at_1. If its refinement meets the number itself, a rational that
// was not known as one, Sign_at_1 goes on with an empty interval and throws.
int AlgebraicTimes::sign(const IntegerPolynomial& q, int i) const {
  if (q.is_zero() || q.degree() == 0) return q.is_zero() ? 0 : sgn(q.c[0]);
  const Polynomial kernel_q = kernel_polynomial(q);
  const Real& time = zeros_->times[i];
  if (time.low() != time.high() && zeros_->kernel.is_zero_at_1_object()(kernel_q, time)) return 0;
  while (time.low() != time.high() && !surely_no_zero_in_unit(on_interval(q, time))) time.refine();
  return static_cast<int>(kernel_q.sign_at(time.low()));
}

detector::TimeEnclosure AlgebraicTimes::enclosure(int i) const {
  const Real& time = zeros_->times[i];
  const auto compare = zeros_->kernel.compare_1_object();
  return enclose_time(CGAL::to_double(time), 0, 1,
                      [&](double t) { return static_cast<int>(compare(time, Bound(t))); });
}

}  // namespace assay::oracle
