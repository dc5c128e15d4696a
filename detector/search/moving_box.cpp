#include "detector/search/moving_box.h"

#include <algorithm>
#include <cmath>

namespace assay::detector {

FloatGrid::FloatGrid(const PositionsView& x_t0, const PositionsView& x_t1) {
  if (x_t0.rows() == 0) return;
  for (int k = 0; k < 3; ++k) {
    const double lo = std::min(x_t0.col(k).minCoeff(), x_t1.col(k).minCoeff());
    const double hi = std::max(x_t0.col(k).maxCoeff(), x_t1.col(k).maxCoeff());
    // Halves first: neither sum nor difference overflows.
    centre_[k] = 0.5 * lo + 0.5 * hi;
    int exponent = 0;
    std::frexp(0.5 * hi - 0.5 * lo, &exponent);
    constexpr int least_exponent = -1022, greatest_exponent = 1022;
    scale_[k] = std::ldexp(1.0, -std::clamp(exponent, least_exponent, greatest_exponent));
    common_scale_ = k == 0 ? scale_[k] : std::min(common_scale_, scale_[k]);
  }
}

void RoundedPositions::assign(const PositionsView& x_t0, const PositionsView& x_t1) {
  grid_ = FloatGrid(x_t0, x_t1);
  points_.resize(static_cast<std::size_t>(x_t0.rows()));
  for (std::size_t v = 0; v < points_.size(); ++v) {
    points_[v] = grid_(x_t0, x_t1, static_cast<std::int32_t>(v));
  }
}

}  // namespace assay::detector
