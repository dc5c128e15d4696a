#include "detector/boxes/shortened_step.h"

#include <algorithm>
#include <cmath>

#include "detector/mesh/for_all.h"

namespace assay::detector {

double place_between(double from, double to, double share) {
  const double way = to - from;
  // The difference of the greatest doubles is none.
  const double at = std::isfinite(way) ? from + share * way : (1 - share) * from + share * to;
  return std::clamp(at, std::min(from, to), std::max(from, to));
}

ShortenedStep::ShortenedStep(const SteppedMesh& step, double until, PacedStop& pace) {
  if (until == 0) {
    motion_.emplace(step.at_start());
    return;
  }
  constexpr std::uint64_t work_of_vertex = 3;
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
      sum_over_all(static_cast<std::size_t>(step.size()), work_of_vertex, &pace, 0.0, place, join);
  motion_.emplace(SteppedMesh{step.vertices_t0, end_});
  // The product may underflow, by 2^-1075 at most.
  slack_ = 0x1p-48 * largest + 0x1p-1070;
}

}  // namespace assay::detector
