// What more cores would make of a step, measured on one.
//
// The arena below has many lanes and one thread. It does the pieces of each loop one after the
// other and takes the time of each. A piece is given to the lane that would be the first to be
// done with what it has, as threads that take piece by piece would do. A loop then takes as long
// as its longest lane. What the arena has saved is the time of all pieces, less the time of the
// longest lane of each loop, so a step that took T would have taken T - saved with as many cores
// as lanes. The pieces are those of a real run with as many threads, because a detector cuts its
// loops by the number of lanes. What threads cost is left out: waking them, and sharing caches.
#pragma once

#include <memory>

#include "detector/parallel/thread_arena.h"

namespace assay::reports {

// What an arena has measured since it was made, in ns.
struct MeasuredLoops {
  double pieces = 0;         // the time of all pieces of all loops
  double longest_lanes = 0;  // the sum over the loops of the time of the longest lane
  double saved() const { return pieces - longest_lanes; }
};

// Adds to `measured`, which must outlive the arena.
std::unique_ptr<detector::ThreadArena> make_measuring_arena(std::size_t lanes,
                                                            MeasuredLoops& measured);

}  // namespace assay::reports
