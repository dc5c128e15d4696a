// Aims contacts: the path of a vertex is chosen so that it meets a feature at a chosen time.
//
// The time is a dyadic number, and the place a dyadic combination of vertices. The contact is
// exact if coordinates have few bits, and otherwise lies beside the exact one. Another contact may
// come first.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Changes one step of the draft, which has two frames or more. Tags "aim:..." say what it aims at
// (face, edge, vertex, edge-edge, grazing, simultaneous, coplanar, region-border) and when (start,
// end, mid-step). If `may_touch_at_start` is set, t = 0 and coplanar aims occur too.
void aim(Random& random, Draft& draft, bool may_touch_at_start);

}  // namespace assay::properties
