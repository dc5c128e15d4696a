// The relation of a case, which says which pairs count (detector/mesh/counted_pairs.h), for a mesh
// that has changed.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/types.h"

namespace assay::properties {

// What has become of the vertices. Several old vertices may be one new one; it has the body and the
// place at rest of the old one that it was.
struct NewVertices {
  std::vector<std::int32_t> number;  // by old vertex: its new number, or -1 if it is gone
  std::vector<std::int32_t> was;     // by new vertex: an old number of it
};

// The relation for the triangles `after`, over new vertices, that were `before`, over old ones. A
// triangle stays the same if its three vertices do. Pairs in lists of which a part is gone are left
// out, and so are bodies without vertices; the others are numbered anew in their old order.
detector::CountedPairs carried_over(const detector::CountedPairs& pairs,
                                    const detector::Triangles& before,
                                    const detector::Triangles& after, const NewVertices& vertices);

}  // namespace assay::properties
