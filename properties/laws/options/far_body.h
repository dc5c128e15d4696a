// A body that makes a small case large, so that a detector shares its work out to several threads.
#pragma once

#include <optional>

#include "corpus/cases/case_file.h"

namespace assay::properties {

// The case with a sheet of 12,544 vertices behind its own, far from it: some loops over vertices
// then have four pieces (detector/mesh/for_all.h), so that with two or three threads some lane
// takes two of them. Seen from above the sheet is a grid that rests; its heights change from frame
// to frame. So it meets nothing, and it has no two triangles without a common vertex that come
// within `apart`: what a step answers is what it answers without the sheet. In a relation it is a
// body of its own. Views and facts are dropped. Nothing if coordinates are too large or too small.
std::optional<corpus::Case> with_far_body(corpus::Case c, double apart);

}  // namespace assay::properties
