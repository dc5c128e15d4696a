// Rung 2 of the elementary test: exact integers. It always decides. It treats every degenerate
// case by the same few rules (contact_exact.cpp).
#pragma once

#include <optional>

#include "detector/contact/four_points.h"

namespace assay::detector {

// The first contact time, or nothing if there is no contact. If only yes or no is wanted, any time
// stands for a contact. Exact for all finite inputs. 0.2 to 1 us for coordinates of similar
// magnitude.
std::optional<TimeEnclosure> exact_first_contact(const FourPoints& query,
                                                 Want want = Want::first_time);

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
