// Exact values of the view function at one time, by the clamp form of L1 and by regions.
//
// All coordinates are integers in one unit, which is a power of two over the denominator of the
// time. So the values are rationals with one common denominator, |d|^2, and only the numerators
// are kept.
#pragma once

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <limits>
#include <span>

#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"

namespace assay::properties {

using ExactInteger = boost::multiprecision::cpp_int;
using ExactPoint = std::array<ExactInteger, 3>;

// Where a point lies along the axis of the segment q0q1, which decides from where it is seen.
enum class Region : std::uint8_t {
  r0,  // before q0: view from q0
  r1,  // beyond q1: view from q1
  r2,  // the slab between: view from the foot of the perpendicular
};

class ExactView {
 public:
  // Takes a triangle and its primitive at t = eighths / 8. REQUIRES finite coordinates.
  ExactView(const std::array<detector::MovingPoint, 3>& triangle,
            const detector::ViewPrimitive& primitive, int eighths);

  // A corner of the triangle, or the point with these weights (w0 + w1 + w2 = 2^4); both times
  // 2^4.
  ExactPoint corner(int i) const;
  ExactPoint inner_point(const std::array<int, 3>& sixteenths) const;

  // (x - n(x)).N for a point of the triangle that is given times 2^4. The values of all points of
  // one ExactView have the same positive factor.
  ExactInteger by_clamp(const ExactPoint& x) const;   // (1-s) f0 + s f1
  ExactInteger by_region(const ExactPoint& x) const;  // from q0, from q1, from the foot
  Region region_of(const ExactPoint& x) const;

  bool has_zero_area() const;

 private:
  ExactInteger axial(const ExactPoint& x) const;  // times |d|^2
  std::array<ExactPoint, 3> triangle_;            // all of these times 2^4
  ExactPoint q0_, q1_, d_, normal_;
  ExactInteger length2_;  // |d|^2, or 1 for a point
};

// The smallest and the largest magnitude of the values that a law rests on in one step, such as the
// determinants whose signs it compares. A value near 0 beside large ones means that the law was
// tried close to where rounding could break it.

// The range of magnitudes, none of them negative. At first it holds no value.
struct ValueRange {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0;

  void widen(double size) { widen({size, size}); }
  void widen(const ValueRange& other) {
    smallest = std::min(smallest, other.smallest);
    largest = std::max(largest, other.largest);
  }
};

inline constexpr double close_share = 0.01;
// Whether the smallest is at most 1 % of the largest.
inline bool is_close(const ValueRange& range) {
  return range.smallest <= close_share * range.largest;
}

// The values are |(x - n(x)).N| at the vertices of the triangles, at 17 times of the step. A sign
// change of a triangle counts as 0. They are in units of the step's own, so that nothing
// overflows.
//
// Looks at the triangles given (indices into `surface`), all seen from one primitive. The rows of
// x are the vertices of the surface. About 0.5 us a triangle.
ValueRange view_range(const detector::Topology& surface, std::span<const std::int32_t> triangles,
                      const detector::SteppedMesh& motion,
                      const detector::ViewPrimitive& primitive);

}  // namespace assay::properties
