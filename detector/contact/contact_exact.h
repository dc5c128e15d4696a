// The integer rungs of the elementary test: integers of fixed width, and integers without bound for
// what these leave open. Together they decide every query. They treat every degenerate case by the
// same few rules (contact_exact.cpp).
#pragma once

#include <optional>

#include "detector/contact/elementary.h"
#include "detector/mesh/step_types.h"

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

// The rung `fixed`: exact integers of fixed width. The query's coordinates choose the smallest of a
// few widths that suffices. This rung never decides wrongly. Its decision is `open` if signs over a
// few pieces of the step do not tell, or if the exponents of the coordinates spread too far. It
// allocates nothing.

struct FixedResult {
  Decision decision = Decision::open;
  TimeEnclosure time;  // set only if the decision is yes and a time is wanted
};

// 0.2 to 1 us for coordinates of similar magnitude.
FixedResult fixed_contact(const FourPoints& query, Want want);

// The only root of the coplanarity cubic in (lo, hi), with the preconditions of
// exact_bracketed_time; nothing if exponents spread too far. 0.4 us.
std::optional<TimeEnclosure> fixed_bracketed_time(const FourPoints& query, double lo, double hi,
                                                  double guess);

}  // namespace assay::detector
