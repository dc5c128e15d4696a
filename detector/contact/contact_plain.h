// The elementary test in plain doubles or floats: the ladder with bounds 0 and no integers. It
// promises nothing; it exists to be measured.
#pragma once

#include "detector/contact/elementary.h"

namespace assay::detector {

// `rung` is always `filter`, and the time is one double. Number is double or float; coordinates
// are rounded to it first. REQUIRES a query that separated_along_an_axis did not settle.
// 0.1 to 1 us.
template <class Number>
ContactResult plain_contact(const FourPoints& query, Want want);

}  // namespace assay::detector
