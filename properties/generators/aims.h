// What is aimed in a mesh that moves: its contacts, and the place of its view primitive.
//
// Contacts: the path of a vertex is chosen so that it meets a feature at a chosen time. The time is
// a dyadic number, and the place a dyadic combination of vertices. The contact is exact if
// coordinates have few bits, and otherwise lies beside the exact one. Another contact may come
// first.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Changes one step of the draft, which has two frames or more. Tags "aim:..." say what it aims at
// (face, edge, vertex, edge-edge, grazing, simultaneous, coplanar, region-border) and when (start,
// end, mid-step). If `may_touch_at_start` is set, t = 0 and coplanar aims occur too.
void aim(Random& random, Draft& draft, bool may_touch_at_start);

// View primitives: none (the detector's own), points and segments, anywhere. Sets q0, q1 for all
// frames; tags "view:...". A third of the cases gets none.
void choose_view(Random& random, Draft& draft);

// For meshes that are positive from `drift`, which has a place for each frame. The view is none, a
// point there, or a short segment about it.
void choose_inner_view(Random& random, Draft& draft, const Points& drift);

}  // namespace assay::properties
