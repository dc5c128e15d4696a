// Random polynomials with known roots. A failure prints the least case and how to reproduce it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "detector/exact/real_root.h"

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

}  // namespace
}  // namespace assay::detector
