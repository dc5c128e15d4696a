#include "detector/search/feature_boxes.h"

#include "detector/parallel/for_all.h"

namespace assay::detector {
namespace {

FloatLanes diagonals(const Point& y) {
  return FloatLanes{static_cast<float>(y[0] + y[1] + y[2]), static_cast<float>(y[0] + y[1] - y[2]),
                    static_cast<float>(y[0] - y[1] + y[2]),
                    static_cast<float>(-y[0] + y[1] + y[2])};
}

}  // namespace

FeaturePoints::FeaturePoints(const SteppedMesh& motion, PacedStop* pace) {
  constexpr std::uint64_t work_of_vertex = 8;
  const FloatGrid f(motion, pace);
  if (pace && pace->stopped()) return;
  const auto count = static_cast<std::size_t>(motion.size());
  points_ = std::make_unique_for_overwrite<FeaturePoint[]>(count);
  for_all_paced(count, work_of_vertex, pace, [&](std::size_t v) {
    const auto vertex = static_cast<std::int32_t>(v);
    points_[v] = {f(motion, vertex),
                  {diagonals(f.scaled(motion.vertices_t0, vertex)),
                   diagonals(f.scaled(motion.vertices_t1, vertex))}};
  });
}

}  // namespace assay::detector
