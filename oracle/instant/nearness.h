// Whether features of a mesh at rest are nearer to each other than a given distance.
#pragma once

#include <functional>

#include "detector/mesh/types.h"

namespace assay::oracle {

// Whether a pair of triangles counts.
using WantedPair = std::function<bool(std::int32_t, std::int32_t)>;

// Whether two triangles that count are in contact at rest, as instant_contacts.h has it, or hold a
// vertex and a face, or two edges, that share no vertex and are nearer to each other than
// `distance`: exactly, by squared distances in rationals. With distance 0: whether there is a
// contact. REQUIRES indices in range, finite positions, distance finite and not negative. 5 to 20
// us for each pair of features whose boxes are that near; ends at the first.
bool any_nearer_than(const detector::PositionsView& x, const detector::TrianglesView& triangles,
                     double distance, const WantedPair& counts);

}  // namespace assay::oracle
