// Computes where two triangles in contact meet, for programs that respond to contacts: the point,
// its barycentric coordinates in both triangles, and the normal. All three are computed in doubles
// with bounds, and no answer of the detector depends on them. This computes the place of each
// contact in a result:
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
  // For each triangle of the pair, the weights of its corners, in the order of the mesh. Each
  // weight is >= 0, and the three add up to 1 up to rounding.
  std::array<Point, 2> barycentric{};
  // The largest difference, in any coordinate, between `point` and the weighted sum of the corners
  // of either triangle. Mostly 2^-48 times the largest coordinate of both triangles; more if two
  // edges are nearly parallel, or if the triangles do not meet.
  double error = 0;
  // If one feature is a face, this is the unit normal of the face, towards the side from which its
  // corners are seen counter-clockwise. For two edges a and b, this is the unit vector in the
  // direction of (a1 - a0) x (b1 - b0). No coordinate is off by more than normal_error. There is no
  // normal if normal_error would be 0.5 or more.
  std::optional<Point> normal;
  double normal_error = 0;
};

// Returns the place of a contact. If the two triangles have the same vertices, this is the place of
// the first vertex. REQUIRES that contact.feature is set and belongs to these triangles, and that
// positions are finite. Takes 0.5 to 1 us, without allocation.
ContactPlace contact_place(const SteppedMesh& motion, const TrianglesView& triangles,
                           const PairContact& contact);

}  // namespace assay::detector
