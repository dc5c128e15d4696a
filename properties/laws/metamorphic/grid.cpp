#include "properties/laws/metamorphic/grid.h"

#include <algorithm>
#include <cmath>

namespace assay::properties {

void move_points(PinnedRun& run, const std::function<detector::Point(detector::Point)>& move) {
  for (auto& frame : run.frames) {
    for (Eigen::Index v = 0; v < frame.rows(); ++v) {
      const auto p = move({frame(v, 0), frame(v, 1), frame(v, 2)});
      frame.row(v) << p[0], p[1], p[2];
    }
  }
  const auto move_path = [&](detector::MovingPoint& path) {
    path.t0 = move(path.t0);
    path.t1 = move(path.t1);
  };
  for (auto& of_step : run.primitives) {
    for (auto& primitive : of_step) {
      move_path(primitive.q0);
      move_path(primitive.q1);
    }
  }
  for (auto& of_step : run.apexes) {
    for (auto& apex : of_step) move_path(apex);
  }
}

int exponent_above(const PinnedRun& run) {
  double greatest = 0;
  const auto look = [&](const detector::Point& p) {
    for (const double c : p) greatest = std::max(greatest, std::abs(c));
    return p;
  };
  PinnedRun copy = run;
  move_points(copy, look);
  int exponent = 0;
  std::frexp(greatest, &exponent);
  return exponent;
}

PinnedRun on_a_grid(PinnedRun run) {
  constexpr int bits = 30, least_exponent = -1074;
  const int unit = std::max(exponent_above(run) - bits, least_exponent);
  move_points(run, [&](detector::Point p) {
    for (double& c : p) {
      // The unit is not below 2^-1074, because all doubles are multiples of that. c / unit stays
      // below 2^30.
      c = std::ldexp(std::nearbyint(std::ldexp(c, -unit)), unit);
    }
    return p;
  });
  return run;
}

}  // namespace assay::properties
