// Static contacts: which triangles meet at one instant, by integers alone.
#pragma once

#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/instant/instant.h"

namespace assay::oracle {

// All pairs in contact at the instant, ascending. Contact is defined in detector/README.md, The
// laws: two closed faces that share no vertex meet, so pairs that share a vertex or an edge are in
// contact when they meet beyond it; same three vertices: in contact. REQUIRES indices in range.
// 0.1 to 0.4 s for 20,000 triangles; the same set as that of judge_step where nothing moves.
std::vector<detector::TrianglePair> contacts_at(const Instant& instant,
                                                const detector::TrianglesView& triangles,
                                                int jobs = 1);

// Whether there is any; ends at the first.
bool any_contact_at(const Instant& instant, const detector::TrianglesView& triangles, int jobs = 1);

// touched[t] is 1 for each triangle that meets another triangle of its own component, or a ghost of
// it. Ghosts and triangles name vertices of the one instant; component[i] is that of triangle i,
// ghosts after the triangles.
std::vector<std::uint8_t> touched_at(const Instant& instant,
                                     const detector::TrianglesView& triangles,
                                     const detector::TrianglesView& ghosts,
                                     const std::vector<std::int32_t>& component, int jobs = 1);

}  // namespace assay::oracle
