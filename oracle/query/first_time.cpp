// Signs that prove a claim [lo, hi] if F is not identically zero:
//
//   claimed     | where lo = hi                               | where lo < hi, adjacent
//   not before  | F has no zero in [0, lo)                    | F has no zero in [0, lo]
//   coplanar    | F(lo) = 0                                   | F(lo) F(hi) < 0
//   contact     | of an axis no two L have opposite signs,    | of an axis all four L have one sign
//               | and not all are 0                           | on [lo, hi], so at the zero inside
//
// That a polynomial has no zero on a piece is shown by Descartes' rule in Bernstein form. Whatever
// these signs leave open, a false claim above all, is settled by solving.
#include "oracle/query/first_time.h"

#include <cmath>

#include "oracle/processor_state.h"
#include "oracle/query/algebraic_answer.h"
#include "oracle/query/contact.h"
#include "oracle/query/times/algebraic_times.h"

namespace assay::oracle {
namespace {

FourPoints points_of(const Query& query) {
  return std::visit([](const auto& q) { return four_points(q); }, query);
}

// p(s + (e - s) t) times a positive power of two, for doubles s < e in [0,1].
IntegerPolynomial on_piece(const IntegerPolynomial& p, double s, double e) {
  // s = m 2^-k and e = n 2^-k: Horner in the linear polynomial that goes from m to n.
  constexpr int mantissa_bits = 53;
  int exponent_s = 0, exponent_e = 0;
  std::frexp(s, &exponent_s);
  std::frexp(e, &exponent_e);
  const int smallest = s == 0 ? exponent_e : std::min(exponent_s, exponent_e);
  const int k = mantissa_bits - smallest;
  const mpq_class at_s(s), at_e(e);
  const mpz_class scale = mpz_class(1) << static_cast<unsigned>(k);
  const mpz_class m = mpz_class(at_s.get_num() * (scale / at_s.get_den()));
  const mpz_class n = mpz_class(at_e.get_num() * (scale / at_e.get_den()));
  const IntegerPolynomial time = linear(m, n);
  IntegerPolynomial value;
  mpz_class power = 1;
  for (int i = p.degree(); i >= 0; --i) {
    value = value * time;
    const mpz_class term = p.c[static_cast<std::size_t>(i)] * power;
    if (term != 0) value = value + IntegerPolynomial{{term}};
    power *= scale;
  }
  return value;
}

// p / (1 - t)^m, where m is the multiplicity of the zero at 1. REQUIRES p not identically zero.
IntegerPolynomial without_zero_at_one(IntegerPolynomial p) {
  while (true) {
    // p = (1 - t) q + rest: the coefficients of q are the partial sums, the rest is the whole sum.
    IntegerPolynomial q;
    mpz_class sum = 0;
    for (const mpz_class& c : p.c) q.c.push_back(sum += c);
    if (sum != 0) return p;
    q.c.pop_back();
    while (!q.c.empty() && q.c.back() == 0) q.c.pop_back();
    p = std::move(q);
  }
}

bool keeps_sign_on(const IntegerPolynomial& p, double s, double e) {
  return sign_at(p, s) != 0 && surely_no_zero_in_unit(on_piece(p, s, e));
}

// Whether the signs of the L prove a contact at the zero of F in the claim.
bool surely_contact(ContactPolynomials& polynomials, const detector::TimeEnclosure& claim) {
  for (int axis = 0; axis < 3; ++axis) {
    bool positive = false, negative = false, open = false;
    for (const IntegerPolynomial& side : polynomials.sides(axis)) {
      const int sign = sign_at(side, claim.lo);
      positive = positive || sign > 0;
      negative = negative || sign < 0;
      if (claim.lo < claim.hi) open = open || !keeps_sign_on(side, claim.lo, claim.hi);
    }
    if (open) continue;
    if (positive && negative) return false;
    if (positive || negative) return true;
  }
  return false;
}

bool proved_by_signs(ContactPolynomials& polynomials, const detector::TimeEnclosure& claim) {
  const IntegerPolynomial& f = polynomials.coplanarity();
  if (f.is_zero()) return false;
  if (claim.lo == claim.hi) {
    if (sign_at(f, claim.lo) != 0) return false;
    if (claim.lo > 0 && !surely_no_zero_in_unit(without_zero_at_one(on_piece(f, 0, claim.lo)))) {
      return false;
    }
  } else {
    if (sign_at(f, claim.lo) * sign_at(f, claim.hi) >= 0) return false;
    if (claim.lo > 0 && !keeps_sign_on(f, 0, claim.lo)) return false;
  }
  return surely_contact(polynomials, claim);
}

}  // namespace

std::optional<std::strong_ordering> compare_first_times(const Query& a, const Query& b) {
  require_exact_processor_state();
  ContactPolynomials polynomials_a(points_of(a)), polynomials_b(points_of(b));
  std::vector<IntegerPolynomial> events = event_polynomials(polynomials_a);
  for (auto& p : event_polynomials(polynomials_b)) events.push_back(std::move(p));
  const AlgebraicTimes times(events);
  const auto meets = [&times](ContactPolynomials& polynomials, int i) {
    const IntegerPolynomial& f = polynomials.coplanarity();
    return (f.is_zero() || times.sign(f, i) == 0) && contact_at(polynomials, times, i);
  };
  int first_a = -1, first_b = -1;
  for (int i = 0; i < times.size(); ++i) {
    if (first_a < 0 && meets(polynomials_a, i)) first_a = i;
    if (first_b < 0 && meets(polynomials_b, i)) first_b = i;
    if (first_a >= 0 && first_b >= 0) return first_a <=> first_b;
  }
  return std::nullopt;
}

ClaimCheck check_first_time(const Query& query, const detector::TimeEnclosure& claim) {
  require_exact_processor_state();
  const bool in_step = claim.lo >= 0 && claim.hi <= 1;
  const bool well_formed = claim.lo == claim.hi || claim.hi == std::nextafter(claim.lo, 2.0);
  if (!in_step || !well_formed) return {false, ClaimRung::signs};
  ContactPolynomials polynomials(points_of(query));
  if (proved_by_signs(polynomials, claim)) return {true, ClaimRung::signs};
  const ExactAnswer solved = algebraic_answer(polynomials, detector::Want::first_time);
  return {solved.contact && solved.first == claim, ClaimRung::solved};
}

}  // namespace assay::oracle
