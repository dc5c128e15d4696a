// A second, independent referee for one vertex-face or edge-edge query.
//
// Guarantee: `no` and `yes` are proved, by other means than contact.h uses: no coplanarity cubic,
// no roots, no code of the rungs. `open` means that neither proof was found. This is usual if
// features touch without crossing, and rare otherwise.
//   no:  [0,1] is cut into pieces, and on each piece some direction separates the two hulls
//        (existence.h);
//   yes: the origin lies in the hull of differences at a rational time, or a box of time and two
//        parameters holds a zero by Poincare-Miranda (existence.h).
// Coordinates must be finite. Cost: 1 us if a direction separates over the whole step, tens of us
// for a contact, up to tens of ms for queries near touching and for `open`. Thread safe. Ends the
// process when the processor does not round to nearest or flushes denormals.
#pragma once

#include <cstdint>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

struct RefereeOptions {
  // The step is halved this often at most, 0 to 61. 17 halvings prove every `no` of random queries;
  // a query that differs from a touching query in bit b needs about b halvings.
  int depth = 60;
  // At most this many pieces of the step are looked at.
  std::uint64_t max_boxes = 1000;
  // The question is about [0,until] instead of the whole step: above 0, at most 1.
  double until = 1;
};

// Judges a query. A greater depth may decide a query that was open; it never turns a no into a yes
// or a yes into a no.
detector::Decision referee(const detector::FourPoints& query, const RefereeOptions& options = {});

// A proof of contact by rational arithmetic between two times.
//
// It serves contacts that begin and end between two adjacent doubles, or at one irrational time: a
// test at a rational time does not find them. It shares the order of the four points
// (query/contact_events.h) with the rungs, and nothing with the rest of the referee.

// Returns true if it found a time in (lo, hi) at which the two features meet, or two times with
// such a time between them. The proof, in the notation of query/contact_events.h: F changes its
// sign between two rational times, or is zero at one, and between these times the four L of some
// axis are all >= 0 or all <= 0, and at least one of them is never zero. So F has a zero there, and
// at that zero the hulls meet. False says nothing: there is no proof for features that are coplanar
// throughout, or that meet in an end point of an edge at an irrational time. REQUIRES finite
// coordinates and 0 <= lo < hi <= 1. Takes some ms.
bool meet_between(const detector::FourPoints& query, double lo, double hi);

}  // namespace assay::oracle
