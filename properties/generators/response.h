// The caller's answer to a collision, made part of a case: try, shorten, try again, commit.
#pragma once

#include "corpus/cases/case_file.h"

namespace assay::properties {

// Each step of `c` that collides becomes an evaluation that is not committed, then a step shortened
// to a part s of its displacement, committed when that is free and reverted when not (also where
// the contact is at t = 0). s is 1, 3/4 or 1/4, by the step's number, of the greatest power of two
// that is at most half of the first contact time. What comes later keeps its own displacements,
// from where the mesh then is. Frames and script are explicit, so the case replays without the
// oracle. `c` has no script of its own; a view primitive goes with the frames. Expected facts and
// ghosts are dropped. Costs the oracle's judgement of each step and of each shortened one.
corpus::Case with_response(const corpus::Case& c);

}  // namespace assay::properties
