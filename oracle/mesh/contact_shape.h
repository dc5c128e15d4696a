// What is special about a contact: the ways in which a careless test misses one.
#pragma once

#include <cstdint>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// A contact has the first of these shapes that holds. F is the cubic whose zeros are the times at
// which the four points lie in a plane (contact_events.h).
enum class ContactShape : std::uint8_t {
  parallel_edges,       // the two edges are parallel, or one is a point, throughout the step
  coplanar_throughout,  // F is zero throughout
  double_root,          // F has a zero of multiplicity 2 or 3 at the time of the contact
  at_end_of_feature,    // the vertex meets an edge of the face, or one edge an end of the other
  generic,
};

// The shape of the first contact of a query. REQUIRES that the query has a contact and that
// `first` encloses its first time. About 50 us; in degenerate queries a few ms.
ContactShape shape_of(const detector::VertexFace& query, const detector::TimeEnclosure& first);
ContactShape shape_of(const detector::EdgeEdge& query, const detector::TimeEnclosure& first);

}  // namespace assay::oracle
