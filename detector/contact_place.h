// Computes where two triangles in contact meet, for programs that respond to contacts: the point,
// its barycentric coordinates in both triangles, the normal. It is computed in doubles with bounds;
// no answer of the detector rests on it. This asks for the place of each contact of a result:
//
//   for (const PairContact& contact : result.pairs)
//     respond(contact, contact_place({x_t0, x_t1}, triangles, contact));
#pragma once

#include <array>
#include <optional>

#include "detector/mesh/step_types.h"

namespace assay::detector {

// The place of a contact at the time contact.time.lo.
struct ContactPlace {
  Point point{};
  // The weights of the corners of each triangle of the pair, in the order of the mesh: >= 0, and
  // together 1 up to rounding.
  std::array<Point, 2> barycentric{};
  // No coordinate of `point` is farther than this from the sum of the weighted corners of either
  // triangle. Mostly 2^-48 of the largest coordinate of the two; more if two edges are nearly
  // parallel, or if the triangles do not meet.
  double error = 0;
  // The unit normal of the face, on the side from which its corners go counter-clockwise. For two
  // edges a and b, it has the direction of (a1 - a0) x (b1 - b0). No coordinate is off by more than
  // normal_error. There is no normal if normal_error would be 0.5 or more.
  std::optional<Point> normal;
  double normal_error = 0;
};

// Returns the place of a contact. Two triangles with the same vertices meet at the first of these.
// REQUIRES a contact of these triangles whose feature is named, and finite positions. 0.5 to 1 us,
// no allocation.
ContactPlace contact_place(const SteppedMesh& motion, const TrianglesView& triangles,
                           const PairContact& contact);

}  // namespace assay::detector
