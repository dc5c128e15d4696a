#include "oracle/instant/instant.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

namespace {

mpq_class times_power_of_two(mpq_class x, int exponent) {
  const auto shift = static_cast<mp_bitcnt_t>(std::abs(exponent));
  if (exponent >= 0) {
    mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), shift);
  } else {
    mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), shift);
  }
  return x;
}

// lo = hi = x if x is a double. Otherwise lo and hi are the two neighbours of the double to which
// GMP truncates x (what is too small for a double becomes 0 or a smallest double), so they enclose
// x.
void enclose(const mpq_class& x, double& lo, double& hi) {
  lo = hi = x.get_d();
  if (mpq_class(lo) == x) return;
  constexpr double largest = std::numeric_limits<double>::max();
  lo = std::nextafter(lo, -largest);
  hi = std::nextafter(hi, largest);
}

}  // namespace

Instant::Instant(const detector::PositionsView& x) : Instant({x, x}, RationalTime{0, 1}) {}

Instant::Instant(const detector::SteppedMesh& motion, const RationalTime& t) {
  assert(motion.vertices_t0.rows() == motion.vertices_t1.rows());
  assert(t.denominator > 0 && t.numerator >= 0 && t.numerator <= t.denominator);
  assert(t.denominator < (std::int64_t{1} << 31));
  const auto count = static_cast<std::int32_t>(motion.size());
  std::vector<detector::MovingPoint> paths;
  paths.reserve(count);
  // At t=0 and t=1 the other end is not used: it must not make the integers longer.
  const bool at_start = t.numerator == 0, at_end = t.numerator == t.denominator;
  for (std::int32_t v = 0; v < count; ++v) {
    paths.push_back(
        {at_end ? motion.end(v) : motion.start(v), at_start ? motion.start(v) : motion.end(v)});
  }
  const IntegerScale scale(paths);
  exponent_ = scale.exponent();
  const bool at_rest = at_start || at_end;
  if (!at_rest) denominator_ = static_cast<long>(t.denominator);
  const long to_end = static_cast<long>(t.numerator);
  const long to_start = static_cast<long>(t.denominator - t.numerator);

  points_.resize(count);
  boxes_.resize(count);
  for (std::int32_t v = 0; v < count; ++v) {
    const detector::MovingPoint& p = paths[v];
    for (int k = 0; k < 3; ++k) {
      if (at_rest || p.t0[k] == p.t1[k]) {
        points_[v][k] = scale(p.t0[k]) * denominator_;
        boxes_[v].min[k] = boxes_[v].max[k] = p.t0[k];
        continue;
      }
      points_[v][k] = scale(p.t0[k]) * to_start + scale(p.t1[k]) * to_end;
      mpq_class place(points_[v][k], denominator_);
      place.canonicalize();
      enclose(times_power_of_two(place, exponent_), boxes_[v].min[k], boxes_[v].max[k]);
    }
  }
}

mpq_class Instant::in_units(const mpq_class& coordinate) const {
  return times_power_of_two(coordinate, -exponent_) * denominator_;
}

mpq_class Instant::in_units(double coordinate) const { return in_units(mpq_class(coordinate)); }

}  // namespace assay::oracle
