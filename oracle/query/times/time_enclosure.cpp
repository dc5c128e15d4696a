#include "oracle/query/times/time_enclosure.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace assay::oracle {

namespace {

constexpr int greatest_degree = 6;

}  // namespace

double guess_zero(const IntegerPolynomial& f, double s, double e, int sign_at_s) {
  std::array<double, greatest_degree + 1> c{};
  long greatest = std::numeric_limits<long>::min();
  for (const Integer& x : f.c) {
    long exponent = 0;
    mpz_get_d_2exp(&exponent, x.get_mpz_t());
    if (sgn(x) != 0) greatest = std::max(greatest, exponent);
  }
  for (std::size_t i = 0; i < f.c.size(); ++i) {
    long exponent = 0;
    const double fraction = mpz_get_d_2exp(&exponent, f.c[i].get_mpz_t());
    constexpr long vanishing_exponent = -2000;
    c[i] =
        std::ldexp(fraction, static_cast<int>(std::max(exponent - greatest, vanishing_exponent)));
  }
  double lo = s, hi = e, t = 0.5 * (s + e);
  constexpr int most_steps = 100;
  for (int step = 0; step < most_steps; ++step) {
    double value = 0, slope = 0;
    for (int i = f.degree(); i >= 0; --i) {
      slope = slope * t + value;
      value = value * t + c[i];
    }
    if (value == 0) break;
    ((value > 0) == (sign_at_s > 0) ? lo : hi) = t;
    const double newton = t - value / slope;
    const double next = newton > lo && newton < hi ? newton : 0.5 * (lo + hi);
    if (next == t || !(lo < hi)) break;
    t = next;
  }
  return t;
}

detector::TimeEnclosure simple_zero_time(const IntegerPolynomial& f, double s, double e) {
  const int sign_at_s = sign_at(f, s);
  assert(f.degree() <= greatest_degree && sign_at_s * sign_at(f, e) < 0);
  return enclose_time(guess_zero(f, s, e, sign_at_s), s, e,
                      [&](double t) { return sign_at(f, t) * sign_at_s; });
}

}  // namespace assay::oracle
