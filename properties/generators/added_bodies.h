// Bodies that are added to a case, far from its own.
#pragma once

#include <array>
#include <optional>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"
#include "properties/random.h"

namespace assay::properties {

// Two triangles without a common vertex that come within a distance d, only just do, or only just
// do not. They move rigidly over a step: a0 a1 a2 at rest, and b0 b1 b2. Their nearest features lie
// in a known direction, so their distance is known without rounding: it is d, the double before or
// after d, a share of 2^-20 less, or half of d; at the end of the step, at its start, throughout,
// or at the middle alone. The features are a vertex and a face, edge or vertex, or two edges,
// crossing or parallel.
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

// A body that makes a small case large, so that a detector shares its work out to several threads.
//
// The case with a sheet of 12,544 vertices behind its own, far from it: some loops over vertices
// then have four pieces (detector/mesh/for_all.h), so that with two or three threads some lane
// takes two of them. Seen from above the sheet is a grid that rests; its heights change from frame
// to frame. So it meets nothing, and it has no two triangles without a common vertex that come
// within `apart`: what a step answers is what it answers without the sheet. In a relation it is a
// body of its own. Views and facts are dropped. Nothing if coordinates are too large or too small.
std::optional<corpus::Case> with_far_body(corpus::Case c, double apart);

}  // namespace assay::properties
