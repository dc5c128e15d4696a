#include "detector/exact/real_root.h"

#include <array>
#include <cassert>
#include <cmath>

#include "detector/exact/root_bracket.h"
#include "detector/exact/root_isolation.h"
#include "detector/exact/square_free.h"

namespace assay::detector {
namespace {

// About where f changes sign between lo and hi, in plain double arithmetic. This is a guess that
// saves exact evaluations and decides nothing.
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

RealRoot enclosed(const Polynomial& f, const IsolatedRoot& root) {
  if (root.is_time()) return {root.lo, root.doubles};
  const auto [lo, hi] = root.doubles;
  if (adjacent(lo, hi)) return {f, root.lo, root.hi, root.sign_after_lo, root.doubles};
  const auto doubles = bracket_root([&f](double time) { return f.sign_at(Dyadic::of(time)); },
                                    root.sign_after_lo, lo, hi, approximate_root(f, lo, hi));
  if (doubles.lo == doubles.hi) return {Dyadic::of(doubles.lo), doubles};
  return {f, Dyadic::of(doubles.lo), Dyadic::of(doubles.hi), root.sign_after_lo, doubles};
}

// The isolated roots of `simple`, the square-free part of f. REQUIRES that f has the sign changes
// of_f over (0,1).
std::vector<IsolatedRoot> isolated_roots(const Polynomial& simple, const Polynomial& f,
                                         SignChanges of_f, Roots wanted) {
  const bool is_f = simple.degree() == f.degree();
  return isolate_roots(simple, is_f ? of_f : sign_changes_over_unit(simple), wanted);
}

// The double that a dyadic time is, or the two adjacent doubles around it.
TimeEnclosure doubles_around(const Dyadic& time) {
  const Integer scale = Integer(1) << static_cast<unsigned>(-time.exponent);
  const Polynomial f = Polynomial::linear(-time.mantissa, scale - time.mantissa);
  if (f.sign_at_zero() == 0) return {0, 0};
  if (f.sign_at_one() == 0) return {1, 1};
  return enclose_single_root(f, 0, 1, -1);
}

}  // namespace

RealRoot::RealRoot(const Dyadic& exact_time) : RealRoot(exact_time, doubles_around(exact_time)) {}

RealRoot::RealRoot(const Dyadic& exact_time, TimeEnclosure doubles)
    : lo_(exact_time), hi_(exact_time), enclosure_(doubles) {}

RealRoot::RealRoot(const Polynomial& f, const Dyadic& lo, const Dyadic& hi, int sign_after_lo,
                   TimeEnclosure doubles)
    : lo_(lo), hi_(hi), sign_after_lo_(sign_after_lo), f_(f), enclosure_(doubles) {}

TimeEnclosure enclose_single_root(const Polynomial& f, double lo, double hi, double guess) {
  const int sign_lo = f.sign_at(Dyadic::of(lo));
  assert(sign_lo != 0 && f.sign_at(Dyadic::of(hi)) == -sign_lo);
  return bracket_root([&f](double time) { return f.sign_at(Dyadic::of(time)); }, sign_lo, lo, hi,
                      guess);
}

bool has_root_in_unit_interval(const Polynomial& f) {
  assert(!f.is_zero());
  const int at_zero = f.sign_at_zero(), at_one = f.sign_at_one();
  if (at_zero == 0 || at_one == 0 || at_zero != at_one) return true;
  const SignChanges changes = sign_changes_over_unit(f);
  return changes.count > 0 && !isolated_roots(square_free_part(f), f, changes, Roots::any).empty();
}

std::vector<RealRoot> roots_in_unit_interval(const Polynomial& f) {
  assert(!f.is_zero());
  std::vector<RealRoot> roots;
  const Dyadic zero = Dyadic::of(0), one = Dyadic::of(1);
  if (f.sign_at_zero() == 0) roots.emplace_back(zero, TimeEnclosure{0, 0});
  const SignChanges changes = sign_changes_over_unit(f);
  if (changes.count == 1) {
    // Exactly one root, and a simple one: nothing to isolate, whatever roots are elsewhere.
    roots.push_back(enclosed(f, {zero, one, {0, 1}, changes.first}));
  } else if (changes.count > 1) {
    const Polynomial simple = square_free_part(f);
    for (const auto& root : isolated_roots(simple, f, changes, Roots::all)) {
      roots.push_back(enclosed(simple, root));
    }
  }
  if (f.sign_at_one() == 0) roots.emplace_back(one, TimeEnclosure{1, 1});
  return roots;
}

}  // namespace assay::detector
