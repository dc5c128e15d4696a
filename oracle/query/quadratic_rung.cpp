#include "oracle/query/quadratic_rung.h"

#include <vector>

#include "oracle/query/times/cubic_times.h"
#include "oracle/query/times/quadratic_times.h"

namespace assay::oracle {

ExactAnswer quadratic_answer(ContactPolynomials& polynomials, detector::Want want) {
  const std::vector<IntegerPolynomial> events = event_polynomials(polynomials);
  if (events.size() > 1) {  // coplanar throughout
    // Many such queries begin in contact: then the other times are not needed.
    const QuadraticTimes start({events.data(), 1});
    const ExactAnswer at_start = first_contact(polynomials, start, want);
    if (at_start.contact) return at_start;
  }
  if (events[0].degree() < 3) return first_contact(polynomials, QuadraticTimes(events), want);
  if (surely_no_zero_in_unit(events[0])) return {};
  return first_contact(polynomials, CubicTimes(events[0]), want);
}

}  // namespace assay::oracle
