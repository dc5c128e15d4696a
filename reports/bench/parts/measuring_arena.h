// What the parts of a step are measured with: an arena that says what more cores would make of it,
// and yardsticks.
//
// The arena below has many lanes and one thread. It does the pieces of each loop one after the
// other and takes the time of each. A piece is given to the lane that would be the first to be
// done with what it has, as threads that take piece by piece would do. A loop then takes as long
// as its longest lane. What the arena has saved is the time of all pieces, less the time of the
// longest lane of each loop, so a step that took T would have taken T - saved with as many cores
// as lanes. The pieces are those of a real run with as many threads, because a detector cuts its
// loops by the number of lanes. What threads cost is left out: waking them, and sharing caches.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "detector/mesh/topology.h"
#include "detector/parallel/thread_arena.h"
#include "detector/parallel/workers.h"

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

// The yardsticks of the view test and of a free step: plain loops over the same arrays. Any method
// with bounding volumes writes boxes first, and any view test reads all corners.

// The box of a triangle swept over a step: least x, y, z, largest x, y, z.
using SweptBox = std::array<double, 6>;

// Writes the boxes by an indexed loop, six doubles for each triangle. REQUIRES that `boxes` has one
// entry for each triangle already.
void write_swept_boxes(const detector::Topology& mesh, const detector::PositionsView& x_t0,
                       const detector::PositionsView& x_t1, std::vector<SweptBox>& boxes);

// Does nothing but read the three corners of every triangle at t=0 and at t=1. The workers share
// the triangles out. The sum is of no use, but without it the compiler would leave the reading out.
double read_plainly(const detector::Topology& mesh, const detector::PositionsView& x_t0,
                    const detector::PositionsView& x_t1, const detector::Workers& workers);

}  // namespace assay::reports
