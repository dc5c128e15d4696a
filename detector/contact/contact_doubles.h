// The elementary test without integers: in doubles with proved bounds (`bounded`), and in plain
// doubles or floats.
#pragma once

#include "detector/contact/elementary.h"
#include "detector/exact/bernstein.h"

namespace assay::detector {

// In doubles with proved bounds alone; what they cannot tell counts as a contact. So it never
// misses a contact. `rung` is `open` if it could not tell whether there is a contact, and so
// reports one. The time is an interval of doubles that holds the first contact time if there is a
// contact: up to lo it is proved that there is none, so lo is never late; hi is a time by which a
// contact is certain, or 1 if none is. REQUIRES a query that separated_along_an_axis did not
// settle. 0.1 to 5 us, no allocation.
ContactResult bounded_contact(const FourPoints& query, Want want);

// Encloses in doubles the first root of a cubic whose coefficients are known only up to a bound.
//
// f holds the Bernstein coefficients over [lo,hi], each off by at most `bound`. REQUIRES that lo
// and hi are k / 2^n with n <= 32, and that the cubic has different signs, beyond the bound, at
// the two ends. For each cubic that f may stand for, the closed interval of the result holds its
// first root in [lo,hi]: it begins at a time up to which there is surely no root, and ends at one
// by which the sign has surely changed. How far apart these are is not promised. 0.1 us; 1 us if
// roots are close together.
TimeEnclosure enclose_first_root(const Cubic& f, double bound, double lo, double hi);

// The elementary test in plain doubles or floats: the ladder with bounds 0 and no integers. It
// promises nothing; it exists to be measured.
//
// `rung` is always `filter`, and the time is one double. Number is double or float; coordinates
// are rounded to it first. REQUIRES a query that separated_along_an_axis did not settle.
// 0.1 to 1 us.
template <class Number>
ContactResult plain_contact(const FourPoints& query, Want want);

}  // namespace assay::detector
