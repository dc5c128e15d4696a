// A proof of contact by rational arithmetic between two times.
//
// It is there for contacts that begin and end within one step of the doubles, or at a time that is
// no fraction: no time that a caller could name shows them. With the rungs it shares the order of
// the four points (query/contact_events.h), with the rest of the referee nothing.
#pragma once

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// True if a time in (lo, hi) was found, or a pair of times around one, at which the two features
// meet. The proof, in the notation of query/contact_events.h: F changes its sign between two
// rational times, or is zero at one, and between these times the four L of some axis are all >= 0
// or all <= 0, and at least one of them is never zero. So F has a zero there, and at that zero the
// hulls meet. False says nothing: features that are coplanar throughout, or that meet at an end of
// an edge at a time that is no fraction, are not proved. REQUIRES finite coordinates and 0 <= lo <
// hi <= 1. Some ms.
bool meet_between(const detector::FourPoints& query, double lo, double hi);

}  // namespace assay::oracle
