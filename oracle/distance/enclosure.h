// Intervals of doubles that hold exact results, without another rounding mode.
//
// A result r, rounded to nearest, differs from the exact one by at most 2^-53 |r|, and by half of
// the least double where it is denormal. It is widened by `slack(r)` = 2^-52 |r| plus the least
// double. That is more than twice as much, so what is lost when the widening itself is rounded, at
// most half a unit in the last place of r or of its neighbour, is made up for. REQUIRES rounding to
// nearest, denormals, and results below the greatest double.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace assay::oracle {

struct Enclosure {
  double lo = 0, hi = 0;

  Enclosure() = default;
  explicit Enclosure(double x) : lo(x), hi(x) {}
  // What lies between two rounded results, with their errors.
  Enclosure(double least, double greatest)
      : lo(least - slack(least)), hi(greatest + slack(greatest)) {}

  static double slack(double r) {
    return std::fabs(r) * 0x1p-52 + std::numeric_limits<double>::denorm_min();
  }
};

inline Enclosure operator+(const Enclosure& a, const Enclosure& b) {
  return {a.lo + b.lo, a.hi + b.hi};
}
inline Enclosure operator-(const Enclosure& a, const Enclosure& b) {
  return {a.lo - b.hi, a.hi - b.lo};
}
inline Enclosure operator*(double s, const Enclosure& a) {
  return s < 0 ? Enclosure{s * a.hi, s * a.lo} : Enclosure{s * a.lo, s * a.hi};
}
inline Enclosure square(const Enclosure& a) {
  const double x = a.lo * a.lo, y = a.hi * a.hi;
  if (a.lo > 0 || a.hi < 0) return {std::min(x, y), std::max(x, y)};
  Enclosure result{0, std::max(x, y)};
  result.lo = 0;
  return result;
}

}  // namespace assay::oracle
