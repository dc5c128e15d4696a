// Moving points of recorded coordinates.
#pragma once

#include "detector/mesh/step_types.h"

namespace assay::bounds {

// A point whose coordinates bear this name and number. In numbers it moves along one line, whatever
// it is called, so that nothing that is computed of such points has a sign.
inline detector::MovingPoint moving_point(const std::string& name, int number) {
  detector::MovingPoint p;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    p.t0[i] = coordinate(name, 2 * number, k, number * (k + 1));
    p.t1[i] = coordinate(name, 2 * number + 1, k, number * (k + 1));
  }
  return p;
}

}  // namespace assay::bounds
