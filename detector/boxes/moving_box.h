// Boxes that move with a step, in floats, and the one test that a search makes of them.
//
// Coordinates are rounded to floats by functions f_x, f_y, f_z, one for each axis, that keep order
// (FloatGrid below): x <= y gives f(x) <= f(y). So f(x) < f(y) proves x < y. So two things that
// touch or meet in doubles are never apart in floats, and no outward rounding is needed.
//
// A box keeps its bounds at t=0 and at t=1. Two boxes are `apart` when they are strictly ordered
// along an axis, in the same sense at both ends. Every point moves linearly, so nothing inside the
// one then meets anything inside the other at any time. This tells more apart than boxes swept
// over the step, which fail as soon as a motion is longer than the things that move.
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

// A vertex over the step.
struct RoundedPoint {
  FloatLanes t0, t1;
};

// A box's bounds at both ends of the step, in one cache line.
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
// overflow. Differences of other points may overflow, to infinities that are still in order.
class FloatGrid {
 public:
  FloatGrid() = default;
  // Makes the grid of a step. Its centre is the middle of all positions. Its scale on each axis is
  // a power of two that brings them near 1. So accuracy does not depend on where a mesh lies or how
  // large it is. O(N).
  // If `pace` was stopped, it must not be used.
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
  // along an axis if they are ordered along it by more than margin(d), or if their boxes are apart
  // although each was grown by half of margin(d). Their distance then exceeds d by 2^-22 or more of
  // the length that the grid brings to 1.
  //
  // f(x) is off by at most 2^-23: |(x - centre) scale| <= 2 is rounded to float, and to double
  // before. Let D = d scale and m = D (1 + 2^-20) + 2^-20. A margin, or a bound of a grown box, is
  // rounded by 2^-24 (2 + m) at most. Boxes are compared after two such roundings. So the order
  // proves that the scaled coordinates differ by more than
  //   m - 2 * 2^-24 (2 + m) - 2 * 2^-23 > D (1 + 2^-20 - 2^-22) + 2^-20 - 2^-21 - 2^-40
  //                                     > D + 2^-22.
  // The rounding of m itself, by 2^-24 m, is covered in the same way. A margin may be infinite.
  FloatLanes margin(double d) const {
    const auto by = [&](int k) { return margin_of(d * scale_[k]); };
    return d == 0 ? FloatLanes{} : FloatLanes{by(0), by(1), by(2), 0};
  }
  // The least distance that has a margin.
  static constexpr double least_distance = std::numeric_limits<double>::denorm_min();
  // Returns the margin for sums of coordinates along the diagonals (feature_pairs.h). It includes
  // the margin that sums need for d = 0. At a distance of d, the sums differ by sqrt(3) d at most.
  float diagonal_margin(double d) const {
    constexpr double root = 1.7320508075688774;
    return margin_of(root * (d * common_scale_));
  }

  // Returns, by axis, how far positions may move before features can meet that boxes with a margin
  // told apart: 2^-26 of the unit, less the error of comparing positions (kept_features.h). It is
  // negative if that error is larger, and NaN if the unit is no double; then no position is near
  // enough.
  std::array<double, 3> tolerance() const {
    const auto r = [&](int k) {
      const double unit = 1 / scale_[k], largest = std::abs(centre_[k]) + 2 * unit;
      return 0x1p-26 * unit - (0x1p-48 * largest + 0x1p-1060);
    };
    return {r(0), r(1), r(2)};
  }

  // Returns (x - centre), multiplied by one power of two for all axes. Each coordinate is at most 2
  // in size for positions of the step.
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
  double common_scale_ = 1;  // the least of the three
};

// The rounded places of all vertices of a step: two for each vertex, or one if the mesh is at rest.
class RoundedPositions {
 public:
  RoundedPositions() = default;
  explicit RoundedPositions(const SteppedMesh& motion) {
    PacedStop pace(never_stops);
    assign(motion, pace);
  }
  // Returns false if `pace` was stopped; some points are then not those of this step.
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

// A step cut off at a time `until`, for boxes that need to cover no more than this part.
//
// Its ends are the places at t=0 and those at `until`, as doubles compute them:
//   x0 + until (x1 - x0), or (1 - until) x0 + until x1 if x1 - x0 overflows,
// and between x0 and x1 in any case. Let M be the largest size of a coordinate of the step, and u
// = 2^-53. In the first form the difference, at most 2 M, is off by 2 M u; the product by another
// 2 M u, and by 2^-1075 if it underflows; the sum by M u: less than 8 M u + 2^-1073 in all, with
// the products of errors. In the second form each product, at most M, is off by 2 M u and
// 2^-1075, and the sum by M u: less than that too. Moving a computed place to between x0 and x1,
// where the true place lies, does not take it farther from the true place.
//
// So each coordinate is off by e = 2^-50 M + 2^-1073 at most, at `until`, and by less before that,
// because both motions are linear and begin at one place. A point is off by sqrt(3) e at most, and
// two features that come within d of each other by `until` do so within d + 2 sqrt(3) e in the
// motion that is computed. The slack is 4 e or more. If `until` is 0, the places are exact and the
// slack is 0.

// Returns the place on the way between two coordinates, computed as above. REQUIRES share in [0,1].
double place_between(double from, double to, double share);

class ShortenedStep {
 public:
  // REQUIRES until in [0,1). The positions of the step must outlive this object. If `pace` was
  // stopped, it must not be used.
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
