// Whether features of a mesh at rest are nearer to each other than a given distance.
#pragma once

#include <functional>
#include <optional>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// Says whether a pair of triangles, the lower index first, is to be looked at.
using WantedPair = std::function<bool(std::int32_t, std::int32_t)>;

// A pair of triangles that `counts` accepts and that is in contact at rest (instant_contacts.h
// says what that is), or holds a vertex and a face, or two edges, that share no vertex and are
// nearer to each other than `distance`; nothing if there is none. The comparison is exact, of
// squared distances in rationals. With distance 0 the question is whether there is a contact.
// REQUIRES indices in range, finite positions, distance finite and not negative. 5 to 20 us for
// each pair of features whose boxes are that near; stops at the first that it finds.
std::optional<detector::TrianglePair> any_nearer_than(const detector::PositionsView& x,
                                                      const detector::TrianglesView& triangles,
                                                      double distance, const WantedPair& counts);

}  // namespace assay::oracle
