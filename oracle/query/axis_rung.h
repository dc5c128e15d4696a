// The first rung of the oracle's elementary test. It only compares inputs, so it is exact for
// every finite input. About 0.03 us.
#pragma once

#include "oracle/query/four_points.h"

namespace assay::oracle {

// True when along some axis one group of points (the vertex and the face, or the two edges) lies
// strictly before the other at t=0 and at t=1.
// It then does so at every time, because each difference of two coordinates is linear in time, so
// there is no contact.
bool separated_by_axis(const FourPoints& q);

}  // namespace assay::oracle
