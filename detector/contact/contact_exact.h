// The integer rungs of the elementary test: integers of fixed width (contact_fixed.h), and integers
// without bound for what these leave open. Together they decide every query. They treat every
// degenerate case by the same few rules (contact_exact.cpp).
#pragma once

#include <optional>

#include "detector/contact/elementary.h"

namespace assay::detector {

// Whether there is a contact, its first time if that is wanted, and the rung (fixed or unbounded)
// that decided. If only yes or no is wanted, any time stands for a contact. Exact for all finite
// inputs. 0.2 to 1 us for coordinates of similar magnitude.
ContactResult exact_contact(const FourPoints& query, Want want = Want::first_time);

// The time of a contact that the filter has bracketed. REQUIRES that this time is the only root of
// the coplanarity cubic in (lo, hi), and that the cubic changes its sign there. `guess` is about
// that time. 0.4 us for coordinates of similar magnitude.
TimeEnclosure exact_bracketed_time(const FourPoints& query, double lo, double hi, double guess);

// The same in integers without bound alone. The functions above fall back on these. 5 to 50 us for
// coordinates of similar magnitude; the time grows with the spread of their exponents, to 2 ms
// over all doubles.
std::optional<TimeEnclosure> general_first_contact(const FourPoints& query);
TimeEnclosure general_bracketed_time(const FourPoints& query, double lo, double hi, double guess);

// Whether the four points are coplanar at all times, which means that the coplanarity cubic
// vanishes identically.
bool coplanar_throughout(const FourPoints& query);

}  // namespace assay::detector
