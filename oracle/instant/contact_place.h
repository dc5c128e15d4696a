// Where two triangles in contact meet, found exactly and then rounded to doubles, and whether two
// triangles cross or only touch.
#pragma once

#include <array>
#include <optional>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// All of it is at the time `contact.time.lo`: that of the contact, or the double just before it.
struct ContactPlace {
  detector::Point point{};
  // The weights of the corners of each triangle of the pair, in the order of the mesh. They lie in
  // [0, 1] and add up to 1 within 2^-51.
  std::array<detector::Point, 2> barycentric{};
  // No coordinate of `point` is farther than this from the sum of the weighted corners of either
  // triangle, as exact arithmetic has that sum. It is at most 2^-49 of the largest coordinate of
  // the two triangles (contact_place.cpp), plus 2^-1070.
  double error = 0;
  // The unit normal of the face, on the side from which its corners go counter-clockwise; of two
  // edges a and b in the direction of (a1 - a0) x (b1 - b0). Each coordinate is within
  // normal_error. Nothing where the face or the edges have none.
  std::optional<detector::Point> normal;
};
constexpr double normal_error = 0x1p-50;

// The place of a contact. Nothing if its feature is not named, or is an edge parallel to the face
// that it is said to pierce. REQUIRES features of the two triangles; if they do not meet, `error`
// is as large as that shows. 30 to 100 us.
std::optional<ContactPlace> contact_place(const detector::SteppedMesh& motion,
                                          const detector::TrianglesView& triangles,
                                          const detector::PairContact& contact);

// Whether two triangles at rest cross: no plane has one on each of its closed sides. Triangles that
// meet and do not cross touch, also if they lie on each other in one plane. Exact, 10 to 30 us.
bool triangles_cross(const detector::PositionsView& x, const detector::TrianglesView& triangles,
                     const detector::TrianglePair& pair);

}  // namespace assay::oracle
