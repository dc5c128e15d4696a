// Tells why a contact may be missed, as far as the mesh alone shows it. Causes distinguish the
// failures of a detector whose stages are unknown.
//
// A cause is a text: "t inside, moving, coplanar throughout, sharing an edge, near contact at the
// start, huge numbers". It says, in this order:
//
// - The time of the exact contact. "near 0": after 0, but in the first thousandth (2^-10) of the
//   step. "at 1": at 1, or so little before it (2^-40) that the step ends some units of the last
//   place beyond the contact. Left out without a contact.
// - Whether some vertex of the two features moves; without a contact, of the two triangles.
// - The special shape of the contact. "without area": a triangle of the pair has no area at t = 0,
//   at t = 1, or at a contact whose time is a double. Else the shape is that of
//   oracle/query/contact.h, but features at rest are "generic" in place of "coplanar throughout".
//   For a question about distance it is where the nearest points of the two features lie at the
//   first time within the distance, computed in doubles; or that the pair never comes within it.
//   Left out without a contact of features, and for piercing.
// - The vertices that the two triangles share, if any: many detectors do not test neighbours, and
//   say so. The features of a query share none.
// - That the pair is not in contact at t = 0, but some vertex and face, or two edges, of the two
//   triangles that share no vertex are then nearer than 1e-5 of the mesh's extent, by exact
//   distances. The extent is the longest side of the box around all vertices at t = 0.
// - The size of the coordinates of the two triangles, zeros left aside: "huge" if some are above
//   2^40, about 1e12; else "tiny" if some are below 2^-40.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "properties/words.h"

namespace assay::properties {

// Below, `of_distance` says that a contact is a pair that comes within a distance.

// Returns the cause for a contact of the oracle in the step. `of_query`: the contact is that of the
// two features of a query (query_case.h). The triangles of its mesh hold more than these features,
// so only the area of the face counts.
std::string cause_of(const TrianglesView& triangles, const SteppedMesh& motion,
                     const PairContact& contact, bool of_distance = false, bool of_query = false);
// Returns the cause for a pair of triangles that is not in contact, or for two features of a query
// that do not meet.
std::string cause_of(const TrianglesView& triangles, const SteppedMesh& motion, TrianglePair pair,
                     bool of_distance = false, const std::optional<Feature>& query = {});

// Returns the oddity of the cause at the end of a signature; 0 for the most ordinary cause, and for
// none. People look at the least odd failures first, and at triangles without a shared vertex
// before neighbours.
int oddity_of(std::string_view signature);

// Orders signatures for people: the least odd first, equally odd ones by their text.
struct LeastOddFirst {
  bool operator()(std::string_view a, std::string_view b) const;
};

}  // namespace assay::properties
