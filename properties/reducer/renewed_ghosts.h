// The ghosts of a case for a changed mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "corpus/cases/case_file.h"

namespace assay::properties {

// Fans over the unmatched edges of `triangles`, which name vertices of `before`. A fan takes the
// apex of the first old ghost with which it shares a vertex, or else the mean of its loop. Vertex
// v of the old ghosts has become target[v]. REQUIRES before.ghosts.
corpus::CaseGhosts renewed_ghosts(const corpus::Case& before, const detector::Triangles& triangles,
                                  const std::vector<std::int32_t>& target);

}  // namespace assay::properties
