// Motions that keep a star shape positive from within, which is the premise of L4 and L5.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Adds `steps` frames to a draft whose triangles (and ghosts) are positive from the origin, and
// chooses the view primitive. In seven of eight cases something comes close to failing: a
// triangle's view value falls to 1 % or less of the largest, by a dent to the view-point, by a
// vertex that nearly reaches the opposite edge as seen from there, or by a view-point just below
// the surface. Tagged "motion:positive" and "close:...".
void move_positively(Random& random, Draft& draft, int steps);

}  // namespace assay::properties
