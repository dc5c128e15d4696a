#include "oracle/query/axis_rung.h"

#include <algorithm>

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

}  // namespace assay::oracle
