// Boxes that move over a step, in floats, and the test that searches make: whether two boxes are
// apart.
//
// Coordinates are rounded to floats by functions f_x, f_y, f_z, one for each axis, that keep order
// (FloatGrid below): x <= y gives f(x) <= f(y). So f(x) < f(y) proves x < y. Therefore the boxes of
// features that touch or meet in doubles are never apart in floats, and no outward rounding is
// needed.
//
// A box keeps its bounds at t=0 and at t=1. Two boxes are `apart` when they are strictly ordered
// along an axis, in the same sense at t=0 and at t=1. Every point moves linearly, so no point of
// one box then meets a point of the other at any time. More pairs are apart in this way than with
// boxes swept over the step, which overlap as soon as features move farther than their own size.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "detector/mesh/for_all.h"
#include "detector/mesh/types.h"
#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace assay::detector {

// Three coordinates and a 0, or sums along four diagonals (feature_pairs.h).
using FloatLanes = float __attribute__((vector_size(16)));
using LaneTruth = int __attribute__((vector_size(16)));

inline FloatLanes least(FloatLanes a, FloatLanes b) { return a < b ? a : b; }
inline FloatLanes greatest(FloatLanes a, FloatLanes b) { return a > b ? a : b; }

inline bool any(LaneTruth truth) {
#ifdef __SSE__
  return _mm_movemask_ps(reinterpret_cast<__m128>(truth)) != 0;
#else
  return (truth[0] | truth[1] | truth[2] | truth[3]) != 0;
#endif
}

// The rounded places of a vertex at t=0 and at t=1.
struct RoundedPoint {
  FloatLanes t0, t1;
};

// The bounds of a box at t=0 and at t=1, in one cache line.
struct alignas(64) MovingBox {
  FloatLanes lo_t0, hi_t0, lo_t1, hi_t1;
};

inline MovingBox box_of(const RoundedPoint& p) { return {p.t0, p.t0, p.t1, p.t1}; }

inline MovingBox box_of(const RoundedPoint& p, const RoundedPoint& q) {
  return {least(p.t0, q.t0), greatest(p.t0, q.t0), least(p.t1, q.t1), greatest(p.t1, q.t1)};
}

inline MovingBox join(const MovingBox& a, const MovingBox& b) {
  return {least(a.lo_t0, b.lo_t0), greatest(a.hi_t0, b.hi_t0), least(a.lo_t1, b.lo_t1),
          greatest(a.hi_t1, b.hi_t1)};
}

inline MovingBox box_of(const RoundedPoint& p, const RoundedPoint& q, const RoundedPoint& r) {
  return join(box_of(p, q), box_of(r));
}

inline bool apart(const MovingBox& a, const MovingBox& b) {
  return any(((a.hi_t0 < b.lo_t0) & (a.hi_t1 < b.lo_t1)) |
             ((b.hi_t0 < a.lo_t0) & (b.hi_t1 < a.lo_t1)));
}

inline MovingBox grown(const MovingBox& box, FloatLanes by) {
  return {box.lo_t0 - by, box.hi_t0 + by, box.lo_t1 - by, box.hi_t1 + by};
}

struct Bounds {
  Point lo, hi;
};

// Returns the bounds of the points point(0), ..., point(count - 1). REQUIRES count > 0.
template <class PointOf>
Bounds bounds_of(std::size_t count, PointOf point, PacedStop* pace) {
  const auto widen = [](Bounds& bounds, const Point& lo, const Point& hi) {
    for (std::size_t k = 0; k < 3; ++k) {
      bounds.lo[k] = std::min(bounds.lo[k], lo[k]);
      bounds.hi[k] = std::max(bounds.hi[k], hi[k]);
    }
  };
  const auto add = [&](Bounds& bounds, std::size_t i) {
    const Point p = point(i);
    widen(bounds, p, p);
  };
  const auto join = [&](Bounds& bounds, const Bounds& other) { widen(bounds, other.lo, other.hi); };
  return sum_over_all(count, 1, pace, Bounds{point(0), point(0)}, add, join);
}

// The functions f, by axis: f(x) = (x - centre) * scale, rounded to double twice and to float
// once. Each of the three roundings keeps order. Finite doubles give floats or infinities, never
// NaN. The centre lies between positions of the step, so their differences from the centre do not
// overflow. The differences of other points from the centre may overflow to infinities, which keep
// order too.
class FloatGrid {
 public:
  FloatGrid() = default;
  // Makes the grid of a step. The centre is the middle of all positions. The scale of each axis is
  // a power of two that makes the largest difference from the centre about 1. So accuracy does not
  // depend on where a mesh lies or how large it is. O(N).
  // If `pace` was stopped, the grid must not be used.
  explicit FloatGrid(const SteppedMesh& motion, PacedStop* pace = nullptr);

  FloatLanes operator()(const PositionsView& x, std::int32_t vertex) const {
    const auto f = [&](int k) {
      return static_cast<float>((x(vertex, k) - centre_[k]) * scale_[k]);
    };
    return FloatLanes{f(0), f(1), f(2), 0};
  }
  RoundedPoint operator()(const SteppedMesh& motion, std::int32_t vertex) const {
    const FloatLanes start = (*this)(motion.vertices_t0, vertex);
    return {start, motion.is_at_rest() ? start : (*this)(motion.vertices_t1, vertex)};
  }

  // Returns margins in floats for a distance d, 0 for d = 0. Two points are farther apart than d
  // along an axis if their rounded coordinates on this axis differ by more than margin(d), or if
  // their boxes, each grown by half of margin(d), are apart along this axis. Then their distance
  // exceeds d by at least 2^-22 / scale.
  //
  // f(x) is off by at most 2^-23, because |(x - centre) scale| <= 2 is rounded to double and then
  // to float. Let D = d scale and m = D (1 + 2^-20) + 2^-20. Rounding changes a margin, or a bound
  // of a grown box, by at most 2^-24 (2 + m), and a comparison of boxes involves two such
  // roundings. So boxes that are apart prove that the scaled coordinates differ by more than
  //   m - 2 * 2^-24 (2 + m) - 2 * 2^-23 > D (1 + 2^-20 - 2^-22) + 2^-20 - 2^-21 - 2^-40
  //                                     > D + 2^-22.
  // The rounding of m itself, by 2^-24 m, is covered in the same way. A margin may be infinite.
  FloatLanes margin(double d) const {
    const auto by = [&](int k) { return margin_of(d * scale_[k]); };
    return d == 0 ? FloatLanes{} : FloatLanes{by(0), by(1), by(2), 0};
  }
  // The least distance for which margin() is not 0.
  static constexpr double least_distance = std::numeric_limits<double>::denorm_min();
  // Returns the margin for sums of coordinates along the diagonals (feature_pairs.h). It includes
  // the margin that sums need for d = 0. The sums of two points at a distance of d differ by at
  // most sqrt(3) d.
  float diagonal_margin(double d) const {
    constexpr double root = 1.7320508075688774;
    return margin_of(root * (d * common_scale_));
  }

  // Returns, by axis, how far positions may move: if the boxes of two features, grown by a margin,
  // are apart, the features cannot meet after the move either. This is 2^-26 units, minus the error
  // of comparing positions (kept_features.h), where a unit is 1 / scale. The result is negative if
  // that error is larger, and NaN if the unit is no double; in both cases no position is near
  // enough.
  std::array<double, 3> tolerance() const {
    const auto r = [&](int k) {
      const double unit = 1 / scale_[k], largest = std::abs(centre_[k]) + 2 * unit;
      return 0x1p-26 * unit - (0x1p-48 * largest + 0x1p-1060);
    };
    return {r(0), r(1), r(2)};
  }

  // Returns x - centre, multiplied by one power of two for all axes. For positions of the step,
  // each coordinate of the result is at most 2 in size.
  Point scaled(const PositionsView& x, std::int32_t vertex) const {
    const auto y = [&](int k) { return (x(vertex, k) - centre_[k]) * common_scale_; };
    return {y(0), y(1), y(2)};
  }

 private:
  static float margin_of(double scaled) {
    return static_cast<float>(scaled * (1 + 0x1p-20) + 0x1p-20);
  }

  double centre_[3] = {0, 0, 0};
  double scale_[3] = {1, 1, 1};
  double common_scale_ = 1;  // the least element of scale_
};

// The rounded places of all vertices of a step: two for each vertex, or one if the mesh is at rest.
class RoundedPositions {
 public:
  RoundedPositions() = default;
  explicit RoundedPositions(const SteppedMesh& motion) {
    PacedStop pace(never_stops);
    assign(motion, pace);
  }
  // Returns false if `pace` was stopped; then some points are not set for this step.
  bool assign(const SteppedMesh& motion, PacedStop& pace);

  const FloatGrid& grid() const { return grid_; }
  bool are_at_rest() const { return ends_ == 1; }
  RoundedPoint operator[](std::int32_t vertex) const {
    const FloatLanes* const first = points_.data() + ends_ * at(vertex);
    return {first[0], first[ends_ - 1]};
  }
  MovingBox box(const std::array<std::int32_t, 3>& triangle) const {
    return box_of((*this)[triangle[0]], (*this)[triangle[1]], (*this)[triangle[2]]);
  }

 private:
  FloatGrid grid_;
  std::size_t ends_ = 2;  // places of each vertex: 2, or 1 at rest
  LargeArray<FloatLanes> points_;
};

// A step that is cut off at a time `until`, for boxes that have to cover only [0, until].
//
// It goes from the places at t=0 to the places at `until`, as doubles compute them:
//   x0 + until (x1 - x0), or (1 - until) x0 + until x1 if x1 - x0 overflows.
// A computed place that is not between x0 and x1 is moved to the nearer of the two. Let M be the
// largest size of a coordinate of the step, and u = 2^-53. In the first form the difference, at
// most 2 M, is off by 2 M u. The product is off by another 2 M u, and by 2^-1075 if it underflows;
// the sum is off by another M u. Together, with the products of errors, this is less than 8 M u +
// 2^-1073. In the second form each product, at most M, is off by 2 M u and 2^-1075, and the sum by
// another M u, which is less than 8 M u + 2^-1073 too. The true place lies between x0 and x1, so
// moving a computed place there brings it no farther from the true place.
//
// So each coordinate is off by at most e = 2^-50 M + 2^-1073 at the time `until`, and by less at
// earlier times, because the true and the computed motion are linear and begin at the same place. A
// point is off by at most sqrt(3) e. So two features that come within d of each other by `until`
// come within d + 2 sqrt(3) e in the computed motion. The slack is 4 e or more. If `until` is 0,
// the places are exact and the slack is 0.

// Returns the coordinate after this share of the way between two coordinates, computed as above.
// REQUIRES share in [0,1].
double place_between(double from, double to, double share);

class ShortenedStep {
 public:
  // REQUIRES until in [0,1). The positions of the step must outlive this object. If `pace` was
  // stopped, this object must not be used.
  ShortenedStep(const SteppedMesh& step, double until, PacedStop& pace);

  const SteppedMesh& motion() const { return *motion_; }
  // Features that come within d by `until` come within d + slack() in motion().
  double slack() const { return slack_; }

 private:
  Positions end_;
  std::optional<SteppedMesh> motion_;
  double slack_ = 0;
};

}  // namespace assay::detector
