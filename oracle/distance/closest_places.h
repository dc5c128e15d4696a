// The nearest places of two features at one time, in plain doubles: a guess that nothing rests on.
#pragma once

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// Vertex-face: the second place is b0 + first (b1 - b0) + second (b2 - b0) of the face b.
// Edge-edge: the places are a0 + first (a1 - a0) and b0 + second (b1 - b0). The shares are >= 0,
// and at most 1; of a face also their sum.
struct ClosestPlaces {
  double first = 0, second = 0;
  detector::Point apart{};  // from the second place to the first
  double squared = 0;       // the square of the distance
};

ClosestPlaces closest_places(const detector::FourPoints& q, double t);

}  // namespace assay::oracle
