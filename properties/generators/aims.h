// Contacts aimed at: a vertex's path is chosen so that it meets a feature at a chosen time.
//
// The time is a dyadic, the place a dyadic combination of vertices: exact where coordinates have
// few bits, beside exact otherwise. Something else may come first.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Changes one step of the draft (which has two frames or more); tags "aim:..." for what it aims at
// (face, edge, vertex, edge-edge, grazing, simultaneous, coplanar, region-border) and when (start,
// end, mid-step). `may_touch_at_start`: t = 0 and coplanar aims too.
void aim(Random& random, Draft& draft, bool may_touch_at_start);

}  // namespace assay::properties
