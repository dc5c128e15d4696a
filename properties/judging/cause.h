// Describes the special properties of a contact that a detector may miss. Such a description is
// called the cause of a failure. Causes distinguish the failures of a detector whose stages are
// unknown.
//
// A cause is a text: "t inside, moving, coplanar throughout, sharing an edge, near contact at the
// start, huge numbers". It says, in this order:
//
// - The time of the exact contact. "near 0": after 0, but in the first thousandth (2^-10) of the
//   step. "at 1": at 1, or at most 2^-40 before 1. Without a contact the cause states no time.
// - Whether some vertex of the two features moves ("moving", "at rest"); without a contact, whether
//   some vertex of the two triangles moves.
// - The special shape of the contact. "without area": a triangle of the pair has no area at t = 0,
//   at t = 1, or at the time of contact if this time is a double. Other shapes are those of
//   oracle/query/contact.h, but features at rest are "generic" in place of "coplanar throughout".
//   For a question about distance the shape says where the nearest points of the two features lie
//   at the first time within the distance, computed in doubles, or "beyond the distance" if the
//   pair never comes so near. A pair without a contact of features has no other shape.
// - The vertices that the two triangles share, if any. They matter because many detectors do not
//   test neighbours. The two features of a query share no vertex.
// - "near contact at the start": the pair is not in contact at t = 0, but some vertex and face, or
//   two edges, of the two triangles are nearer at t = 0 than 1e-5 times the extent of the mesh.
//   Only features without a shared vertex count, and distances are exact. The extent is the longest
//   side of the box around all vertices at t = 0.
// - The size of the nonzero coordinates of the two triangles: "huge numbers" if one is above 2^40,
//   about 1e12; if none is, "tiny numbers" if one is below 2^-40.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "properties/words.h"

namespace assay::properties {

// In the functions below `of_distance` says that a contact is a pair that comes within a distance.

// Returns the cause for a contact of the oracle in the step. `of_query` says that the two features
// of a query (query_case.h) are in contact. The triangles of a query's mesh have further features,
// so "without area" is only about the query's face.
std::string cause_of(const TrianglesView& triangles, const SteppedMesh& motion,
                     const PairContact& contact, bool of_distance = false, bool of_query = false);
// Returns the cause for a pair of triangles that is not in contact, or for two features of a query
// that do not meet.
std::string cause_of(const TrianglesView& triangles, const SteppedMesh& motion, TrianglePair pair,
                     bool of_distance = false, const std::optional<Feature>& query = {});

// Returns the oddity of the cause at the end of a signature. It is 0 for the most ordinary cause,
// and for a signature without a cause. People want to see the least odd failures first, and
// triangles without a shared vertex before neighbours.
int oddity_of(std::string_view signature);

// Orders signatures by the oddity of their causes, then by their text.
struct LeastOddFirst {
  bool operator()(std::string_view a, std::string_view b) const;
};

}  // namespace assay::properties
