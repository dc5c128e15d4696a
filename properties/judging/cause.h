// Why a contact may be missed, as far as the mesh alone tells it. It distinguishes the failures of
// a detector whose stages nobody knows.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"

namespace assay::properties {

// When the exact contact is.
enum class CauseTime : std::uint8_t { inside, at_1, at_0 };

// What is special about the contact: the first of these that holds, for features at rest without
// `coplanar_throughout`. `without_area`: a triangle of the pair has no area at t = 0, at t = 1, or
// at a contact whose time is a double. The others are those of oracle/mesh/contact_shape.h.
enum class CauseShape : std::uint8_t {
  generic,
  double_root,
  at_end_of_feature,
  coplanar_throughout,
  parallel_edges,
  without_area,
};

// How large the coordinates of the two triangles are, leaving zeros aside. `ordinary`: all from
// 2^-40 to 2^40, about 1e-12 to 1e12; `huge`: some are above that; `tiny`: some are below, none
// above.
enum class CauseNumbers : std::uint8_t { ordinary, tiny, huge };

struct Cause {
  std::optional<CauseTime> time;  // nothing if there is no contact
  // Some vertex of the two features moves; without a contact, some vertex of the two triangles.
  bool is_moving = true;
  std::optional<CauseShape> shape;  // nothing without a contact, and for piercing
  CauseNumbers numbers = CauseNumbers::ordinary;
  friend bool operator==(const Cause&, const Cause&) = default;
};

// The cause for a contact of the oracle in the step.
Cause cause_of(const detector::TrianglesView& triangles, const detector::SteppedMesh& motion,
               const detector::PairContact& contact);
// The cause for a contact of the two features of a query (query_case.h). The triangles of its mesh
// hold more than these features, so only the area of the face counts.
Cause cause_of_query(const detector::TrianglesView& triangles, const detector::SteppedMesh& motion,
                     const detector::PairContact& contact);
// The cause for a pair of triangles that is not in contact.
Cause cause_of(const detector::TrianglesView& triangles, const detector::SteppedMesh& motion,
               detector::TrianglePair pair);

// "t inside, moving, coplanar throughout, huge numbers". Ordinary numbers are not mentioned.
std::string text_of(const Cause& cause);

// How odd the cause at the end of a signature is; 0 for the most ordinary one, and for none.
// People look at the least odd failures first.
int oddity_of(std::string_view signature);

}  // namespace assay::properties
