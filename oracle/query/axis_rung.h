// Rung "axis": comparisons of the inputs alone, so exact for every finite input. About 0.03 us.
#pragma once

#include "oracle/query/four_points.h"

namespace assay::oracle {

// True when along some axis one group lies strictly before the other at t=0 and at t=1: then it
// does so at every time, as each difference of two coordinates is linear. No contact.
bool separated_by_axis(const FourPoints& q);

}  // namespace assay::oracle
