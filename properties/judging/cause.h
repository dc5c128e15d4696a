// Why a contact may be missed, as far as the mesh alone says it: what tells two failures of a
// detector apart whose stages nobody knows.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"

namespace assay::properties {

// Of the exact contact.
enum class CauseTime : std::uint8_t { inside, at_1, at_0 };

// The first that holds, of features at rest without `coplanar_throughout`: a triangle of the pair
// has no area at t = 0, at t = 1 or at a contact whose time is a double; then those of
// oracle/mesh/contact_shape.h.
enum class CauseShape : std::uint8_t {
  generic,
  double_root,
  at_end_of_feature,
  coplanar_throughout,
  parallel_edges,
  without_area,
};

// Of the coordinates of the two triangles that are not 0: all from 2^-40 to 2^40, about 1e-12 to
// 1e12; or some above that; or some below it and none above.
enum class CauseNumbers : std::uint8_t { ordinary, tiny, huge };

struct Cause {
  std::optional<CauseTime> time;  // nothing where there is no contact
  // Some vertex of the two features; without a contact, of the two triangles.
  bool is_moving = true;
  std::optional<CauseShape> shape;  // nothing where there is no contact, and for piercing
  CauseNumbers numbers = CauseNumbers::ordinary;
  friend bool operator==(const Cause&, const Cause&) = default;
};

// Of a contact of the oracle in the step from x_t0 to x_t1.
Cause cause_of(const detector::TrianglesView& triangles, const detector::PositionsView& x_t0,
               const detector::PositionsView& x_t1, const detector::PairContact& contact);
// Of a contact of the two features of a query (query_case.h), whose triangles hold more than
// these: only the face's area counts.
Cause cause_of_query(const detector::TrianglesView& triangles, const detector::PositionsView& x_t0,
                     const detector::PositionsView& x_t1, const detector::PairContact& contact);
// Of a pair of triangles that is not in contact.
Cause cause_of(const detector::TrianglesView& triangles, const detector::PositionsView& x_t0,
               const detector::PositionsView& x_t1, detector::TrianglePair pair);

// "t inside, moving, coplanar throughout, huge numbers": ordinary numbers go without saying.
std::string text_of(const Cause& cause);

// How odd the cause is that a signature ends with, 0 for the most ordinary and for none: what
// people look at first is the least odd.
int oddity_of(std::string_view signature);

}  // namespace assay::properties
