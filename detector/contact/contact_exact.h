// Rung 2 of the elementary test: exact integers. Always decides; every degenerate case is treated
// by the same few rules (contact_exact.cpp).
#pragma once

#include <optional>

#include "detector/contact/four_points.h"

namespace assay::detector {

// The first contact time, or nothing. Exact for all finite inputs. 6 to 50 us for coordinates of
// similar magnitude; grows with the spread of their exponents, to tens of ms over all doubles.
std::optional<TimeEnclosure> exact_first_contact(const FourPoints& query);

// The time of a contact of which the filter knows that it is the only root of the coplanarity cubic
// in (lo, hi), where the cubic changes sign. About 5 us.
TimeEnclosure exact_bracketed_time(const FourPoints& query, double lo, double hi, double guess);

// Whether the four points are coplanar at all times: the coplanarity cubic vanishes identically.
bool coplanar_throughout(const FourPoints& query);

}  // namespace assay::detector
