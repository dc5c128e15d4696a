#include "oracle/query/quadratic_rung.h"

#include <vector>

#include "oracle/query/times/common_factor.h"
#include "oracle/query/times/quadratic_times.h"

namespace assay::oracle {

namespace {

IntegerPolynomial derivative(const IntegerPolynomial& p) {
  IntegerPolynomial d;
  for (std::size_t k = 1; k < p.c.size(); ++k) d.c.push_back(p.c[k] * static_cast<unsigned>(k));
  return d;
}

// A proper factor of the cubic F; a constant if none is found.
IntegerPolynomial proper_factor(const IntegerPolynomial& f, ContactPolynomials& polynomials) {
  const IntegerPolynomial from_start = {{0, 1}}, from_end = {{-1, 1}};
  if (sign_at(f, 0) == 0) return from_start;
  if (sign_at(f, 1) == 0) return from_end;
  IntegerPolynomial factor = common_factor(f, derivative(f));
  for (int axis = 0; axis < 3 && factor.degree() == 0; ++axis) {
    for (const IntegerPolynomial& side : polynomials.sides(axis)) {
      if (side.degree() <= 0) continue;
      factor = common_factor(f, side);
      if (factor.degree() > 0) break;
    }
  }
  return factor;
}

}  // namespace

std::optional<ExactAnswer> quadratic_answer(ContactPolynomials& polynomials, detector::Want want) {
  std::vector<IntegerPolynomial> events = event_polynomials(polynomials);
  if (events.size() > 1) {  // coplanar throughout
    // Many such queries begin in contact: then the other times are not needed.
    const QuadraticTimes start({events.data(), 1});
    const ExactAnswer at_start = first_contact(polynomials, start, want);
    if (at_start.contact) return at_start;
  }
  if (events[0].degree() == 3) {
    if (surely_no_zero_in_unit(events[0])) return ExactAnswer{};
    IntegerPolynomial factor = proper_factor(events[0], polynomials);
    if (factor.degree() == 0) return std::nullopt;
    events[0] = cofactor(events[0], factor);
    events.push_back(std::move(factor));
  }
  return first_contact(polynomials, QuadraticTimes(events), want);
}

}  // namespace assay::oracle
