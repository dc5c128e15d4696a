// The bounds of a feature that are compared before any elementary test: a moving box along the
// axes, and one along the four diagonals (1,1,1), (1,1,-1), (1,-1,1), (-1,1,1).
//
// Two features that are strictly ordered along any one direction, in the same sense at both ends
// of the step, are in no contact. Along the axes the order of the floats alone proves this
// (moving_box.h). Along a diagonal the sum of coordinates is rounded, so an order counts only if
// it holds by more than a margin:
//   y_k = (x_k - centre_k) * scale, |y_k| <= 2 (FloatGrid::scaled), is off by 2^-52 at most; a sum
//   of three, at most 6, takes two more roundings and is off by less than 2^-49. It is rounded to
//   the nearest float g, off by at most 2^-22 (half a unit of floats in [4,8)). If
//   g(a) + margin < g(b) in floats, with the sum's own rounding of at most 2^-22 and margin 2^-20,
//   then the true sums differ by more than 2^-20 - 3 * 2^-22 - 2 * 2^-49 > 0.
// So diagonals do not tell apart what lies closer than about a millionth of the mesh's size.
#pragma once

#include <memory>

#include "detector/search/moving_box.h"

namespace assay::detector {

inline constexpr float diagonal_margin = 0x1p-20f;

// A vertex over the step, in one cache line.
struct alignas(64) FeaturePoint {
  RoundedPoint axes, diagonals;
};

struct FeatureBox {
  MovingBox axes, diagonals;
};

inline FeatureBox feature_box(const FeaturePoint& p) {
  return {box_of(p.axes), box_of(p.diagonals)};
}
inline FeatureBox feature_box(const FeaturePoint& p, const FeaturePoint& q) {
  return {box_of(p.axes, q.axes), box_of(p.diagonals, q.diagonals)};
}
inline FeatureBox feature_box(const FeaturePoint& p, const FeaturePoint& q, const FeaturePoint& r) {
  return {box_of(p.axes, q.axes, r.axes), box_of(p.diagonals, q.diagonals, r.diagonals)};
}

inline bool apart_along_diagonals(const MovingBox& a, const MovingBox& b) {
  constexpr float m = diagonal_margin;
  constexpr FloatLanes margin = {m, m, m, m};
  return any(((a.hi_t0 + margin < b.lo_t0) & (a.hi_t1 + margin < b.lo_t1)) |
             ((b.hi_t0 + margin < a.lo_t0) & (b.hi_t1 + margin < a.lo_t1)));
}

inline bool apart(const FeatureBox& a, const FeatureBox& b) {
  return apart(a.axes, b.axes) || apart_along_diagonals(a.diagonals, b.diagonals);
}

// All vertices of a step. Memory: 32 bytes a triangle.
class FeaturePoints {
 public:
  // If `pace` was stopped, they must not be used.
  explicit FeaturePoints(const SteppedMesh& motion, PacedStop* pace = nullptr);
  const FeaturePoint& operator[](std::int32_t vertex) const {
    return points_[static_cast<std::size_t>(vertex)];
  }

 private:
  std::unique_ptr<FeaturePoint[]> points_;
};

}  // namespace assay::detector
