// The rung `fixed` of the elementary test (contact_exact.h): exact integers of fixed width. The
// query's coordinates choose the smallest of a few widths that suffices. This rung never decides
// wrongly. Its decision is `open` if signs over a few pieces of the step do not tell, or if the
// exponents of the coordinates spread too far. It allocates nothing.
#pragma once

#include <optional>

#include "detector/contact/elementary.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

struct FixedResult {
  Decision decision = Decision::open;
  TimeEnclosure time;  // set only if the decision is yes and a time is wanted
};

// 0.2 to 1 us for coordinates of similar magnitude.
FixedResult fixed_contact(const FourPoints& query, Want want);

// The only root of the coplanarity cubic in (lo, hi), with the preconditions of
// exact_bracketed_time (contact_exact.h); nothing if exponents spread too far. 0.4 us.
std::optional<TimeEnclosure> fixed_bracketed_time(const FourPoints& query, double lo, double hi,
                                                  double guess);

}  // namespace assay::detector
