// Certain signs of intervals, for any interval type with inf() and sup().
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace assay::oracle {

// 1 or -1 when every number of the interval has that sign; 0 when that is not certain.
template <class Interval>
int sure_sign(const Interval& x) {
  if (x.inf() > 0) return 1;
  return x.sup() < 0 ? -1 : 0;
}

// 1 or -1 when all coefficients surely have that sign, and so does the polynomial on its piece; 0
// when that is not certain.
template <class Interval, std::size_t N>
int sure_sign(const std::array<Interval, N>& coefficients) {
  const int sign = sure_sign(coefficients[0]);
  for (std::size_t k = 1; k < N && sign != 0; ++k) {
    if (sure_sign(coefficients[k]) != sign) return 0;
  }
  return sign;
}

// Whether every coordinate of the moving points is less than `bound` in magnitude at both ends.
template <class Points>
bool all_coordinates_below(const Points& points, double bound) {
  for (const auto& p : points) {
    for (int k = 0; k < 3; ++k) {
      if (!(std::fabs(p.t0[k]) < bound) || !(std::fabs(p.t1[k]) < bound)) return false;
    }
  }
  return true;
}

}  // namespace assay::oracle
