// The first of the exact rungs: integers of a width that is fixed by the query's coordinates. Never
// decides wrongly; `open` where signs over a few pieces of the step do not tell, or where exponents
// spread too far. No allocation.
#pragma once

#include <optional>

#include "detector/contact/elementary.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

struct FixedResult {
  Decision decision = Decision::open;
  TimeEnclosure time;  // set when contact and wanted
};

// 0.2 to 1 us for coordinates of similar magnitude.
FixedResult fixed_contact(const FourPoints& query, Want want);

// exact_bracketed_time (contact_exact.h), or nothing where exponents spread too far. 0.4 us.
std::optional<TimeEnclosure> fixed_bracketed_time(const FourPoints& query, double lo, double hi,
                                                  double guess);

}  // namespace assay::detector
