#include "detector/search/moving_box.h"

#include <algorithm>
#include <cmath>

namespace assay::detector {

FloatGrid::FloatGrid(const PositionsView& x_t0, const PositionsView& x_t1, PacedStop* pace) {
  if (x_t0.rows() == 0) return;
  constexpr std::uint64_t work_of_vertex = 1;
  Point lo = point_of(x_t0, 0), hi = lo;
  const auto widen = [&](std::size_t v) {
    for (const auto* x : {&x_t0, &x_t1}) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double at_k = (*x)(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(k));
        lo[k] = std::min(lo[k], at_k);
        hi[k] = std::max(hi[k], at_k);
      }
    }
  };
  const auto count = static_cast<std::size_t>(x_t0.rows());
  if (!for_each_paced(count, work_of_vertex, pace, widen)) return;
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
  return for_each_paced(points_.size(), work_of_vertex, pace, [&](std::size_t v) {
    points_[v] = grid_(x_t0, x_t1, static_cast<std::int32_t>(v));
  });
}

}  // namespace assay::detector
