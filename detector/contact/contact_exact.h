// The integer rungs of the elementary test: integers of fixed width (contact_fixed.h), and integers
// without bound for what these leave open. Together they decide every query. Every degenerate case
// is treated by the same few rules (contact_exact.cpp).
#pragma once

#include <optional>

#include "detector/contact/elementary.h"

namespace assay::detector {

// Whether there is a contact, its first time if that is wanted, and the rung (fixed or unbounded)
// that decided. Exact for all finite inputs. 0.2 to 1 us for coordinates of similar magnitude.
ContactResult exact_contact(const FourPoints& query, Want want = Want::first_time);

// The time of a contact of which the filter knows that it is the only root of the coplanarity cubic
// in (lo, hi), where the cubic changes sign. 0.4 us for coordinates of similar magnitude.
TimeEnclosure exact_bracketed_time(const FourPoints& query, double lo, double hi, double guess);

// The same in integers without bound alone: what the above fall back on. 5 to 50 us for coordinates
// of similar magnitude; grows with the spread of their exponents, to 2 ms over all doubles.
std::optional<TimeEnclosure> general_first_contact(const FourPoints& query);
TimeEnclosure general_bracketed_time(const FourPoints& query, double lo, double hi, double guess);

// Whether the four points are coplanar at all times: the coplanarity cubic vanishes identically.
bool coplanar_throughout(const FourPoints& query);

}  // namespace assay::detector
