// Random polynomials with known roots. A failure prints the least case and how to reproduce it.
#include <rapidcheck/gtest.h>

#include "detector/exact/real_root.h"
#include "tests/detector/exact/tarski.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

struct Fraction {
  int numerator, denominator;
  bool in_unit_interval() const { return numerator >= 0 && numerator <= denominator; }
  friend bool operator<(const Fraction& a, const Fraction& b) {
    return a.numerator * b.denominator < b.numerator * a.denominator;
  }
  friend bool operator==(const Fraction& a, const Fraction& b) { return !(a < b) && !(b < a); }
};

Polynomial vanishing_at(const Fraction& f) {
  return Polynomial::linear(-f.numerator, f.denominator - f.numerator);
}

std::vector<Fraction> random_roots(std::size_t most) {
  const auto count = *rc::gen::inRange<std::size_t>(1, most + 1);
  std::vector<Fraction> roots;
  for (std::size_t i = 0; i < count; ++i) {
    roots.push_back({*rc::gen::inRange(-6, 19), *rc::gen::inRange(1, 13)});
  }
  return roots;
}

RC_GTEST_PROP(RealRootProperty, ProductsOfFactorsHaveTheirRoots, ()) {
  auto expected = random_roots(5);
  Polynomial f = Polynomial::constant(*rc::gen::element(-3, 1, 7));
  for (const auto& root : expected) f = f * vanishing_at(root);
  std::erase_if(expected, [](const Fraction& r) { return !r.in_unit_interval(); });
  std::sort(expected.begin(), expected.end());
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());

  const auto found = roots_in_unit_interval(f);
  RC_ASSERT(found.size() == expected.size());
  RC_ASSERT(has_root_in_unit_interval(f) == !expected.empty());
  for (std::size_t i = 0; i < found.size(); ++i) {
    RC_ASSERT(found[i].sign_of(vanishing_at(expected[i])) == 0);
    const double value = static_cast<double>(expected[i].numerator) / expected[i].denominator;
    RC_ASSERT(found[i].enclosure().lo <= value);
    RC_ASSERT(value <= found[i].enclosure().hi);
    for (const auto& other : expected) {
      const int sign = found[i].sign_of(vanishing_at(other));
      RC_ASSERT(sign == (other < expected[i]) - (expected[i] < other));
    }
  }
}

// Coefficients without any order in them: roots that are no fractions, multiple ones by squares.
RC_GTEST_PROP(RealRootProperty, CountsAndSignsAreThoseOfRemainderSequences, ()) {
  const auto draw = [](std::size_t most) {
    const int reach = *rc::gen::element(1, 3, 20, 1000000);
    Polynomial p;
    for (auto n = *rc::gen::inRange<std::size_t>(1, most + 2); n > 0; --n) {
      p = p * Polynomial::linear(0, 1) + Polynomial::constant(*rc::gen::inRange(-reach, reach + 1));
    }
    return p;
  };
  Polynomial f = draw(3);
  if (*rc::gen::arbitrary<bool>()) f = f * draw(2);
  if (*rc::gen::inRange(0, 4) == 0) f = f * f;
  const Dyadic zero = Dyadic::of(0), one = Dyadic::of(1);
  RC_PRE(!f.is_zero() && f.sign_at_zero() != 0 && f.sign_at_one() != 0);
  const auto roots = roots_in_unit_interval(f);
  RC_ASSERT(static_cast<int>(roots.size()) == tests::number_of_roots(f, zero, one));
  RC_ASSERT(has_root_in_unit_interval(f) == !roots.empty());
  const Polynomial q = draw(2);
  int sum = 0;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    sum += roots[i].sign_of(q);
    const auto [lo, hi] = roots[i].enclosure();
    if (i > 0) RC_ASSERT(roots[i - 1].enclosure().hi <= hi);
    if (lo == hi) {
      RC_ASSERT(f.sign_at(Dyadic::of(lo)) == 0);
    } else {
      RC_ASSERT(hi == std::nextafter(lo, 2.0));
    }
  }
  RC_ASSERT(sum == tests::tarski_query(f, q, zero, one));
}

}  // namespace
}  // namespace assay::detector
