// Makes a caller's answer to a collision part of a case: try, shorten, try again, commit.
#pragma once

#include "corpus/cases/case_file.h"

namespace assay::properties {

// Each step of `c` that collides becomes an evaluation that is not committed, and then a step that
// is shortened to a share s of its displacement. The shortened step is committed if it is free,
// and reverted if it is not (also if the contact is at t = 0). s is 1, 3/4 or 1/4, by the step's
// number, of the greatest power of two that is at most half of the first contact time. Later steps
// keep their own displacements, from where the mesh then is.
//
// Frames and script are explicit, so the case replays without the oracle. A view primitive goes
// with the frames. Expected facts and ghosts are dropped. Costs the oracle's judgement of each
// step and of each shortened one. REQUIRES that `c` has no script of its own.
corpus::Case with_response(const corpus::Case& c);

}  // namespace assay::properties
