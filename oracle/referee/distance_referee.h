// A second method, independent of any polynomial of the distance, for one vertex-face or edge-edge
// query: do the two features come within d of each other during the step, and when first?
//
// Guarantee: yes and no are proved, by other means than zeros of polynomials in time: no region of
// a feature has a polynomial of its own here. open means that neither proof was found, which is
// usual when features touch the distance d at no dyadic time and go away again, and rare
// otherwise.
//   no:  [0,1] is cut into pieces, and on each of them some direction keeps the two hulls further
//        apart than d (distance_proofs.h);
//   yes: the nearest points at a rational time are within d of each other (distance_proofs.h), or
//        the features meet (existence.h).
// Coordinates must be finite, and the sum of the distance finite and at least 0. Cost: 2 us if a
// direction separates over the whole step, tens of us for a first time, up to 20 ms for open.
// Thread safe. Ends the process when the processor does not round to nearest or flushes denormals.
#pragma once

#include <cstdint>

#include "oracle/rational_time.h"
#include "oracle/referee/distance_proofs.h"

namespace assay::oracle {

struct DistanceRefereeOptions {
  // The step is halved this often at most, 0 to 60.
  int depth = 60;
  // The bracket of a first time is halved until it is no longer than twice 2^-bits, bits from 0 to
  // 60. Shorter brackets find more wrong times, and where the distance only touches d they need
  // integers.
  int bits = 40;
  // How many pieces of the step are looked at, at most; one that needs integers counts for 8 or
  // more, by the length of its numbers.
  std::uint64_t max_cells = 2000;
};

struct DistanceVerdict {
  detector::Decision within = detector::Decision::open;
  // No time up to and with `after` is within d, unless the verdict is yes and `by` is 0 too: then
  // the first time is 0. So a yes has its first time in (after, by], or at 0. This holds for an
  // open verdict as well: what is within d is so later than `after`.
  RationalTime after{0, 1}, by{1, 1};
  std::uint64_t cells = 0;  // that were looked at
};

DistanceVerdict distance_referee(const detector::VertexFace& query, const detector::Separation& d,
                                 const DistanceRefereeOptions& options = {});
DistanceVerdict distance_referee(const detector::EdgeEdge& query, const detector::Separation& d,
                                 const DistanceRefereeOptions& options = {});

}  // namespace assay::oracle
