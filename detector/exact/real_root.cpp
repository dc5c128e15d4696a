#include "detector/exact/real_root.h"

#include <array>
#include <cassert>
#include <cmath>

#include "detector/exact/root_bracket.h"
#include "detector/exact/sturm.h"

namespace assay::detector {
namespace {

// The factor (t - time) to the power in which f has it, taken out; time must be a root.
Polynomial deflate(const Polynomial& f, const Dyadic& time) {
  // 2^-e t - m vanishes at t = m 2^e.
  const Integer scale = Integer(1) << static_cast<unsigned>(-time.exponent);
  const Polynomial factor = Polynomial::linear(-time.mantissa, scale - time.mantissa);
  Polynomial rest = f;
  while (!rest.is_zero() && rest.sign_at(time) == 0) rest = rest.quotient(factor);
  return rest;
}

// Where f changes sign between lo and hi, in plain double arithmetic: a guess that saves exact
// evaluations and decides nothing.
double approximate_root(const Polynomial& f, double lo, double hi) {
  constexpr unsigned kept_bits = 900;  // far inside the range of double
  unsigned most_bits = 0;
  for (int i = 0; i <= f.degree(); ++i) {
    if (!f[i].is_zero()) most_bits = std::max(most_bits, static_cast<unsigned>(msb(abs(f[i]))));
  }
  const unsigned dropped = most_bits > kept_bits ? most_bits - kept_bits : 0;
  std::array<double, 8> c{};
  if (f.degree() >= static_cast<int>(c.size())) return (lo + hi) / 2;
  for (int i = 0; i <= f.degree(); ++i) {
    c[static_cast<std::size_t>(i)] = Integer(f[i] >> dropped).convert_to<double>();
  }
  const auto value_at = [&](double t) {
    double value = 0;
    for (int i = f.degree(); i >= 0; --i) value = value * t + c[static_cast<std::size_t>(i)];
    return value;
  };
  const bool rising = value_at(lo) < value_at(hi);
  constexpr int halvings = 56;
  for (int i = 0; i < halvings; ++i) {
    const double middle = lo + (hi - lo) / 2;
    ((value_at(middle) < 0) == rising ? lo : hi) = middle;
  }
  return lo;
}

// A time in between: of the order of magnitude in between while these differ. Next to 0, where no
// double is, roots can be at 2^-2000.
Dyadic between(const Dyadic& lo, const Dyadic& hi) {
  const auto magnitude = [](const Dyadic& t) {
    return t.exponent + static_cast<int>(msb(t.mantissa));
  };
  const int greatest = magnitude(hi);
  if (lo.mantissa.is_zero()) return {1, 2 * greatest - 1};
  const int least = magnitude(lo);
  return greatest - least > 2 ? Dyadic{1, (least + greatest) / 2} : lo.midpoint_with(hi);
}

// An interval of times whose ends are doubles as long as a double lies inside.
struct Interval {
  Dyadic lo, hi;
  TimeEnclosure doubles;
  bool inside_gap() const { return adjacent(doubles.lo, doubles.hi); }
};

class Isolation {
 public:
  // f square-free, without roots at the ends of [0,1].
  explicit Isolation(const Polynomial& f) : Isolation(f, SignedRemainders(f, f.derivative())) {}
  Isolation(const Polynomial& f, SignedRemainders sequence)
      : f_(f), sequence_(std::move(sequence)) {}

  void run(std::vector<RealRoot>& out) {
    const Interval unit{Dyadic::of(0), Dyadic::of(1), {0, 1}};
    isolate(unit, sequence_.variations_at(unit.lo), sequence_.variations_at(unit.hi), out);
  }

 private:
  void isolate(const Interval& interval, int variations_lo, int variations_hi,
               std::vector<RealRoot>& out) {
    const int count = variations_lo - variations_hi;
    if (count == 0) return;
    if (count == 1) {
      out.push_back(enclose(interval));
      return;
    }
    // count >= 2: split at a time that is no root; a root there is one of the roots to report.
    Interval left = interval, right = interval;
    if (interval.inside_gap()) {
      left.hi = right.lo = between(interval.lo, interval.hi);
    } else {
      const double middle =
          from_ordinal((ordinal(interval.doubles.lo) + ordinal(interval.doubles.hi)) / 2);
      left.hi = right.lo = Dyadic::of(middle);
      left.doubles.hi = right.doubles.lo = middle;
    }
    const int sign_middle = f_.sign_at(left.hi);
    if (sign_middle == 0) {
      Isolation rest(deflate(f_, left.hi));
      rest.isolate_in(left, out);
      out.emplace_back(left.hi);
      rest.isolate_in(right, out);
      return;
    }
    const int variations_middle = sequence_.variations_at(left.hi, sign_middle);
    isolate(left, variations_lo, variations_middle, out);
    isolate(right, variations_middle, variations_hi, out);
  }

  void isolate_in(const Interval& interval, std::vector<RealRoot>& out) {
    isolate(interval, sequence_.variations_at(interval.lo), sequence_.variations_at(interval.hi),
            out);
  }

  RealRoot enclose(const Interval& interval) const {
    if (interval.inside_gap()) return {f_, interval.lo, interval.hi, interval.doubles};
    const double guess = approximate_root(f_, interval.doubles.lo, interval.doubles.hi);
    const auto doubles = enclose_single_root(f_, interval.doubles.lo, interval.doubles.hi, guess);
    if (doubles.lo == doubles.hi) return RealRoot(Dyadic::of(doubles.lo));
    return {f_, Dyadic::of(doubles.lo), Dyadic::of(doubles.hi), doubles};
  }

  Polynomial f_;
  SignedRemainders sequence_;
};

// The double in which a dyadic time lies, or the two around it.
TimeEnclosure doubles_around(const Dyadic& time) {
  const Integer scale = Integer(1) << static_cast<unsigned>(-time.exponent);
  const Polynomial f = Polynomial::linear(-time.mantissa, scale - time.mantissa);
  if (f.sign_at_zero() == 0) return {0, 0};
  if (f.sign_at_one() == 0) return {1, 1};
  return enclose_single_root(f, 0, 1, -1);
}

// Signs of the Bernstein coefficients of f over [0,1]; the number of sign changes bounds the number
// of roots in (0,1) from above and has its parity.
int bernstein_variations(const Polynomial& f) {
  // Coefficient j, times a positive constant: sum over i <= j of c_i C(n-i, j-i).
  const int n = f.degree();
  int variations = 0, previous = 0;
  for (int j = 0; j <= n; ++j) {
    Integer sum = 0;
    // C(n-i, j-i) for i = j, j-1, ..., 0.
    std::uint64_t binomial = 1;
    for (int i = j; i >= 0; --i) {
      sum += f[i] * binomial;
      binomial =
          binomial * static_cast<std::uint64_t>(n - i + 1) / static_cast<std::uint64_t>(j - i + 1);
    }
    const int sign = sum.sign();
    if (sign == 0) continue;
    if (previous != 0 && sign != previous) ++variations;
    previous = sign;
  }
  return variations;
}

}  // namespace

RealRoot::RealRoot(const Dyadic& exact_time)
    : is_exact_(true), lo_(exact_time), hi_(exact_time), enclosure_(doubles_around(exact_time)) {}

RealRoot::RealRoot(const Polynomial& f, const Dyadic& lo, const Dyadic& hi, TimeEnclosure doubles)
    : lo_(lo), hi_(hi), f_(f), enclosure_(doubles) {}

TimeEnclosure enclose_single_root(const Polynomial& f, double lo, double hi, double guess) {
  const int sign_lo = f.sign_at(Dyadic::of(lo));
  assert(sign_lo != 0 && f.sign_at(Dyadic::of(hi)) == -sign_lo);
  return bracket_root([&f](double time) { return f.sign_at(Dyadic::of(time)); }, sign_lo, lo, hi,
                      guess);
}

bool has_root_in_unit_interval(const Polynomial& f) {
  assert(!f.is_zero());
  if (f.sign_at_zero() == 0 || f.sign_at_one() == 0) return true;
  if (f.sign_at_zero() != f.sign_at_one()) return true;
  if (bernstein_variations(f) == 0) return false;
  const SignedRemainders sequence(f, f.derivative());
  return sequence.variations_at(Dyadic::of(0)) != sequence.variations_at(Dyadic::of(1));
}

std::vector<RealRoot> roots_in_unit_interval(const Polynomial& f) {
  assert(!f.is_zero());
  std::vector<RealRoot> roots;
  const Dyadic zero = Dyadic::of(0), one = Dyadic::of(1);
  Polynomial inside = f;
  if (inside.sign_at_zero() == 0) {
    roots.emplace_back(zero);
    inside = deflate(inside, zero);
  }
  const bool root_at_one = inside.sign_at_one() == 0;
  if (root_at_one) inside = deflate(inside, one);
  const int variations = inside.degree() > 0 ? bernstein_variations(inside) : 0;
  if (variations == 1) {
    // Exactly one root, and a simple one: no sequence is needed to find it.
    const auto doubles = enclose_single_root(inside, 0, 1, approximate_root(inside, 0, 1));
    if (doubles.lo == doubles.hi) {
      roots.emplace_back(Dyadic::of(doubles.lo));
    } else {
      roots.emplace_back(inside, Dyadic::of(doubles.lo), Dyadic::of(doubles.hi), doubles);
    }
  } else if (variations > 1) {
    SignedRemainders sequence(inside, inside.derivative());
    const Polynomial& common = sequence.last();
    if (common.degree() > 0) {
      Isolation(inside.quotient(common)).run(roots);
    } else {
      Isolation(inside, std::move(sequence)).run(roots);
    }
  }
  if (root_at_one) roots.emplace_back(one);
  return roots;
}

}  // namespace assay::detector
