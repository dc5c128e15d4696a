// A second, independent referee for one vertex-face or edge-edge query.
//
// Guarantee: contact and no_contact are proved, by other means than those of contact.h: no
// coplanarity cubic, no roots, no code of the rungs. open means that neither proof was found,
// which is usual when features touch without crossing, and rare otherwise.
//   no_contact: [0,1] is cut into pieces, and on each some direction separates the two hulls
//               (existence.h);
//   contact:    the origin lies in the hull of differences at a rational time, or a box of time
//               and two parameters holds a zero by Poincare-Miranda (existence.h).
// Coordinates must be finite. Cost: 1 us if a direction separates over the whole step, tens of us
// for a contact, up to tens of ms near touching and for open. Thread safe. Ends the process when
// the processor does not round to nearest or flushes denormals.
#pragma once

#include <cstdint>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

struct RefereeOptions {
  // The step is halved this often at most, 0 to 61. 17 halvings confirm every no of random
  // queries; neighbours of a touch need about the number of bits in which they differ from it.
  int depth = 60;
  // At most so many pieces of the step are looked at.
  std::uint64_t max_boxes = 1000;
  // The question is about [0,until] instead of the whole step: above 0, at most 1.
  double until = 1;
};

// A greater depth may decide what was open; it never turns a no into a yes or a yes into a no.
detector::Decision referee(const detector::VertexFace& query, const RefereeOptions& options = {});
detector::Decision referee(const detector::EdgeEdge& query, const RefereeOptions& options = {});
detector::Decision referee(const detector::FourPoints& query, const RefereeOptions& options = {});

}  // namespace assay::oracle
