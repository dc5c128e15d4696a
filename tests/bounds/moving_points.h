// Moving points whose coordinates are recorded numbers.
#pragma once

#include "detector/mesh/step_types.h"
#include "detector/mesh/types.h"

namespace assay::bounds {

// Returns a point whose coordinates have this name and number. All such points have their values on
// one line, so that the values computed from them have no sign.
inline detector::MovingPoint moving_point(const std::string& name, int number) {
  detector::MovingPoint p;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    p.t0[i] = coordinate(name, 2 * number, k, number * (k + 1));
    p.t1[i] = coordinate(name, 2 * number + 1, k, number * (k + 1));
  }
  return p;
}

// Returns the positions of the vertices 0, 1, ... of a mesh at t=0 and t=1.
inline std::array<detector::Positions, 2> moving_vertices(const std::string& name, int count) {
  std::array<detector::Positions, 2> x = {detector::Positions(count, 3),
                                          detector::Positions(count, 3)};
  for (int v = 0; v < count; ++v) {
    const auto p = moving_point(name, v);
    for (int k = 0; k < 3; ++k) {
      x[0](v, k) = p.t0[static_cast<std::size_t>(k)];
      x[1](v, k) = p.t1[static_cast<std::size_t>(k)];
    }
  }
  return x;
}

}  // namespace assay::bounds
