#include "detector/boxes/moving_box.h"

#include <algorithm>
#include <cmath>

#include "detector/mesh/for_all.h"

namespace assay::detector {

FloatGrid::FloatGrid(const SteppedMesh& motion, PacedStop* pace) {
  if (motion.size() == 0) return;
  const std::size_t ends = motion.is_at_rest() ? 1 : 2;
  const auto place = [&](std::size_t i) {
    const auto v = static_cast<std::int32_t>(i >> (ends - 1));
    return (i & (ends - 1)) == 0 ? motion.start(v) : motion.end(v);
  };
  const auto [lo, hi] = bounds_of(ends * static_cast<std::size_t>(motion.size()), place, pace);
  if (pace && pace->stopped()) return;
  for (std::size_t k = 0; k < 3; ++k) {
    // Halved first, so that neither sum nor difference overflows.
    centre_[k] = 0.5 * lo[k] + 0.5 * hi[k];
    int exponent = 0;
    std::frexp(0.5 * hi[k] - 0.5 * lo[k], &exponent);
    // 2^-1024 is a subnormal double; rounding of products with it keeps order.
    constexpr int least_exponent = -1022, greatest_exponent = 1024;
    scale_[k] = std::ldexp(1.0, -std::clamp(exponent, least_exponent, greatest_exponent));
    common_scale_ = k == 0 ? scale_[k] : std::min(common_scale_, scale_[k]);
  }
}

bool RoundedPositions::assign(const SteppedMesh& motion, PacedStop& pace) {
  constexpr std::uint64_t work_of_vertex = 3;
  grid_ = FloatGrid(motion, &pace);
  if (pace.stopped()) return false;
  ends_ = motion.is_at_rest() ? 1 : 2;
  const auto count = static_cast<std::size_t>(motion.size());
  points_ = LargeArray<FloatLanes>(ends_ * count);
  return for_all_paced(count, work_of_vertex, pace, [&](std::size_t v) {
    const auto [t0, t1] = grid_(motion, static_cast<std::int32_t>(v));
    points_[ends_ * v] = t0;
    points_[ends_ * v + ends_ - 1] = t1;
  });
}

double place_between(double from, double to, double share) {
  const double way = to - from;
  // The difference of the greatest doubles overflows.
  const double at = std::isfinite(way) ? from + share * way : (1 - share) * from + share * to;
  return std::clamp(at, std::min(from, to), std::max(from, to));
}

ShortenedStep::ShortenedStep(const SteppedMesh& step, double until, PacedStop& pace) {
  if (until == 0) {
    motion_.emplace(step.at_start());
    return;
  }
  constexpr std::uint64_t work_of_place = 3;
  end_.resize(step.size(), 3);
  const auto place = [&](double& largest, std::size_t v) {
    const auto row = static_cast<Eigen::Index>(v);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double from = step.vertices_t0(row, k), to = step.vertices_t1(row, k);
      end_(row, k) = place_between(from, to, until);
      largest = std::max({largest, std::abs(from), std::abs(to)});
    }
  };
  const auto join = [](double& largest, double other) { largest = std::max(largest, other); };
  const double largest =
      sum_over_all(static_cast<std::size_t>(step.size()), work_of_place, &pace, 0.0, place, join);
  motion_.emplace(SteppedMesh{step.vertices_t0, end_});
  // The product may underflow, by 2^-1075 at most.
  slack_ = 0x1p-48 * largest + 0x1p-1070;
}

}  // namespace assay::detector
