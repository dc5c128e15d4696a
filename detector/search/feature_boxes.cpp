#include "detector/search/feature_boxes.h"

namespace assay::detector {
namespace {

FloatLanes diagonals(const Point& y) {
  return FloatLanes{static_cast<float>(y[0] + y[1] + y[2]), static_cast<float>(y[0] + y[1] - y[2]),
                    static_cast<float>(y[0] - y[1] + y[2]),
                    static_cast<float>(-y[0] + y[1] + y[2])};
}

}  // namespace

FeaturePoints::FeaturePoints(const PositionsView& x_t0, const PositionsView& x_t1)
    : points_(static_cast<std::size_t>(x_t0.rows())) {
  const FloatGrid f(x_t0, x_t1);
  for (std::size_t v = 0; v < points_.size(); ++v) {
    const auto vertex = static_cast<std::int32_t>(v);
    points_[v] = {f(x_t0, x_t1, vertex),
                  {diagonals(f.scaled(x_t0, vertex)), diagonals(f.scaled(x_t1, vertex))}};
  }
}

}  // namespace assay::detector
