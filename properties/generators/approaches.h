// Aims a case at a distance d: two features that come within d, only just do, or only just do not.
#pragma once

#include <array>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"
#include "properties/random.h"

namespace assay::properties {

// Two triangles without a common vertex that move rigidly over a step: a0 a1 a2 at rest, and
// b0 b1 b2. Their nearest features lie in a known direction, so their distance is known without
// rounding: it is d, the double before or after d, a share of 2^-20 less, or half of d; at the end
// of the step, at its start, throughout, or at the middle alone. The features are a vertex and a
// face, edge or vertex, or two edges, crossing or parallel.
struct Approach {
  std::array<detector::MovingPoint, 3> a, b;
};
Approach draw_approach(Random& random, double d);

// Adds the two triangles of an approach to the mesh, far from it, in one step of its script; what
// was expected of the case is dropped. A query (query_case.h) becomes one of the features of an
// approach instead: b0 and the face a, or the edges a0a1 and b0b1. A mesh with coordinates above
// most_aimed stays as it is. REQUIRES a step, and d from least_aimed to most_aimed.
corpus::Case with_approach(corpus::Case c, double d, Random& random);
inline constexpr double least_aimed = 0x1p-900, most_aimed = 0x1p900;

}  // namespace assay::properties
