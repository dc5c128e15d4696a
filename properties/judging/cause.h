// Tells why a contact may be missed, as far as the mesh alone shows it. Causes distinguish the
// failures of a detector whose stages are unknown.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"

namespace assay::properties {

// The time of the exact contact. `near_0`: after 0, but in the first thousandth (2^-10) of the
// step. `at_1`: at 1, or so little before it (2^-40) that the step ends some units of the last
// place beyond the contact.
enum class CauseTime : std::uint8_t { inside, at_1, near_0, at_0 };

// How many vertices the two triangles share: many detectors do not test neighbours, and say so.
enum class CauseSharing : std::uint8_t { nothing, vertex, edge };

// The special shape of the contact. `without_area`: a triangle of the pair has no area at t = 0, at
// t = 1, or at a contact whose time is a double. Else the shape is that of oracle/query/contact.h,
// but features at rest are `generic` in place of `coplanar_throughout`.
enum class CauseShape : std::uint8_t {
  generic,
  double_root,
  at_end_of_feature,
  coplanar_throughout,
  parallel_edges,
  without_area,
  // For a question about distance, these replace all others but without_area: where the nearest
  // points of the two features lie at the first time within the distance, computed in doubles.
  // beyond_distance: the pair never comes within the distance.
  distance_to_face,
  distance_of_edges,
  distance_to_edge,
  distance_of_vertices,
  beyond_distance,
};

// The size of the coordinates of the two triangles, zeros left aside. `ordinary`: all from 2^-40 to
// 2^40, about 1e-12 to 1e12; `huge`: some are above that; `tiny`: some are below, none above.
enum class CauseNumbers : std::uint8_t { ordinary, tiny, huge };

struct Cause {
  std::optional<CauseTime> time;  // nothing if there is no contact
  // Some vertex of the two features moves; without a contact, some vertex of the two triangles.
  bool is_moving = true;
  std::optional<CauseShape> shape;  // nothing without a contact of features, and for piercing
  CauseNumbers numbers = CauseNumbers::ordinary;
  // For a query it is always `nothing`.
  CauseSharing sharing = CauseSharing::nothing;
  // The two triangles are not in contact at t = 0, but two of their features without a common
  // vertex (vertex and face, or two edges) are then nearer than 1e-5 of the mesh's extent, exactly.
  // The extent is the longest side of the box around all vertices at t = 0.
  bool is_near_at_start = false;
  friend bool operator==(const Cause&, const Cause&) = default;
};

// Below, `of_distance` says that a contact is a pair that comes within a distance.

// Returns the cause for a contact of the oracle in the step.
Cause cause_of(const detector::TrianglesView& triangles, const detector::SteppedMesh& motion,
               const detector::PairContact& contact, bool of_distance = false);
// Returns the cause for a contact of the two features of a query (query_case.h). The triangles of
// its mesh hold more than these features, so only the area of the face counts.
Cause cause_of_query(const detector::TrianglesView& triangles, const detector::SteppedMesh& motion,
                     const detector::PairContact& contact, bool of_distance = false);
// Returns the cause for two features of a query that do not meet.
Cause cause_of_query(const detector::TrianglesView& triangles, const detector::SteppedMesh& motion,
                     const detector::Feature& features, bool of_distance = false);
// Returns the cause for a pair of triangles that is not in contact.
Cause cause_of(const detector::TrianglesView& triangles, const detector::SteppedMesh& motion,
               detector::TrianglePair pair, bool of_distance = false);

// Returns "t inside, moving, coplanar throughout, sharing an edge, near contact at the start, huge
// numbers". The last three are left out where they are ordinary: no shared vertex, a start far
// enough apart, ordinary numbers.
std::string text_of(const Cause& cause);

// Returns the oddity of the cause at the end of a signature; 0 for the most ordinary cause, and for
// none. People look at the least odd failures first, and at triangles without a shared vertex
// before neighbours.
int oddity_of(std::string_view signature);

// Orders signatures for people: the least odd first, equally odd ones by their text.
struct LeastOddFirst {
  bool operator()(std::string_view a, std::string_view b) const;
};

}  // namespace assay::properties
