#include "detector/search/moving_box.h"

#include <algorithm>
#include <cmath>

#include "detector/parallel/for_all.h"

namespace assay::detector {

FloatGrid::FloatGrid(const PositionsView& x_t0, const PositionsView& x_t1, PacedStop* pace) {
  if (x_t0.rows() == 0) return;
  constexpr std::uint64_t work_of_vertex = 1;
  struct Bounds {
    Point lo, hi;
  };
  const auto widen = [](Bounds& bounds, const Point& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      bounds.lo[k] = std::min(bounds.lo[k], p[k]);
      bounds.hi[k] = std::max(bounds.hi[k], p[k]);
    }
  };
  const auto widen_by_vertex = [&](Bounds& bounds, std::size_t v) {
    for (const auto* x : {&x_t0, &x_t1}) widen(bounds, point_of(*x, static_cast<std::int32_t>(v)));
  };
  const auto join = [&](Bounds& bounds, const Bounds& other) {
    widen(bounds, other.lo);
    widen(bounds, other.hi);
  };
  const Bounds first = {point_of(x_t0, 0), point_of(x_t0, 0)};
  const auto [lo, hi] = sum_over_all(static_cast<std::size_t>(x_t0.rows()), work_of_vertex, pace,
                                     first, widen_by_vertex, join);
  if (pace && pace->stopped()) return;
  for (std::size_t k = 0; k < 3; ++k) {
    // Halves first: neither sum nor difference overflows.
    centre_[k] = 0.5 * lo[k] + 0.5 * hi[k];
    int exponent = 0;
    std::frexp(0.5 * hi[k] - 0.5 * lo[k], &exponent);
    constexpr int least_exponent = -1022, greatest_exponent = 1022;
    scale_[k] = std::ldexp(1.0, -std::clamp(exponent, least_exponent, greatest_exponent));
    common_scale_ = k == 0 ? scale_[k] : std::min(common_scale_, scale_[k]);
  }
}

bool RoundedPositions::assign(const PositionsView& x_t0, const PositionsView& x_t1,
                              PacedStop& pace) {
  constexpr std::uint64_t work_of_vertex = 3;
  grid_ = FloatGrid(x_t0, x_t1, &pace);
  if (pace.stopped()) return false;
  points_.resize(static_cast<std::size_t>(x_t0.rows()));
  return for_all_paced(points_.size(), work_of_vertex, pace, [&](std::size_t v) {
    points_[v] = grid_(x_t0, x_t1, static_cast<std::int32_t>(v));
  });
}

}  // namespace assay::detector
