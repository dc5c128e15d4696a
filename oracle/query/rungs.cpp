#include "oracle/query/rungs.h"

#include <algorithm>
#include <vector>

#include "oracle/query/times/algebraic_times.h"
#include "oracle/query/times/cubic_times.h"
#include "oracle/query/times/quadratic_time.h"

namespace assay::oracle {

namespace {

// -1: all of S lies strictly before all of S' along the axis; 1: strictly after; 0: neither.
int strict_order(const FourPoints& q, detector::Point detector::MovingPoint::*end, int axis) {
  auto at = [&](int i) { return (q.points[i].*end)[axis]; };
  double s_min = at(0), s_max = at(0);
  for (int i = 1; i < q.first_group; ++i) {
    s_min = std::min(s_min, at(i));
    s_max = std::max(s_max, at(i));
  }
  double r_min = at(3), r_max = at(3);
  for (int i = q.first_group; i < 3; ++i) {
    r_min = std::min(r_min, at(i));
    r_max = std::max(r_max, at(i));
  }
  if (s_max < r_min) return -1;
  return r_max < s_min ? 1 : 0;
}

}  // namespace

bool separated_by_axis(const FourPoints& q) {
  for (int axis = 0; axis < 3; ++axis) {
    const int at_t0 = strict_order(q, &detector::MovingPoint::t0, axis);
    if (at_t0 != 0 && at_t0 == strict_order(q, &detector::MovingPoint::t1, axis)) return true;
  }
  return false;
}

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

ExactAnswer algebraic_answer(ContactPolynomials& polynomials, detector::Want want) {
  return first_contact(polynomials, AlgebraicTimes(event_polynomials(polynomials)), want);
}

}  // namespace assay::oracle
