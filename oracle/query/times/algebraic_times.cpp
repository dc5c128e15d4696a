#include "oracle/query/times/algebraic_times.h"

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <mpfr.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <vector>

#include "oracle/query/times/time_enclosure.h"

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

// q as a polynomial of w, where time = low + w (high - low) on the interval that isolates
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
  const auto solve = zeros_->kernel.solve_1_object();
  const auto compare = zeros_->kernel.compare_1_object();
  std::vector<Real>& times = zeros_->times;
  for (const IntegerPolynomial& p : polynomials) {
    assert(!p.is_zero());
    if (surely_no_zero_in_unit(p)) continue;
    constexpr bool known_to_be_square_free = false;
    solve(kernel_polynomial(p), known_to_be_square_free, Bound(0), Bound(1),
          std::back_inserter(times));
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

// Does not use the kernel's Sign_at_1. When its refinement meets the number itself, a rational
// that was not known as one, that goes on with an empty interval and throws.
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
