// By which methods the answers of a conformance set are known. A query of contact is answered by
// three: the oracle's rungs, CGAL's algebraic kernel, and the referee, which knows no polynomial.
// A query of distance is answered by two, the oracle and its distance referee. The steps of a mesh
// are answered by the oracle, by the referee on every pair of features whose boxes meet, and by the
// detector in exact arithmetic.
#pragma once

#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "properties/random.h"
#include "properties/vectors/vectors.h"

namespace assay::properties {

// The methods that cannot tell are named in `open` of each case. REQUIRES that none contradicts.
void say_open_methods(VectorSet& set, int jobs);

struct VectorContradiction {
  std::string id;
  std::string text;  // "kernel: first time [0.5, 0.5] for [0.25, 0.25]"
};

// Finds everything that a case states once more, by all methods, and tells what is different.
std::vector<VectorContradiction> contradictions_of(const VectorSet& set, int jobs);

// The query with one to three coordinates moved to a neighbouring number of the precision.
detector::FourPoints neighbour_of(detector::FourPoints query, VectorPrecision precision,
                                  Random& random);

struct NeighbourTally {
  std::uint64_t queries = 0, open = 0;
  std::vector<VectorContradiction> contradictions;
};

// Asks all methods about so many neighbours of the set's queries.
NeighbourTally check_neighbours(const VectorSet& set, std::uint64_t count, int jobs);

}  // namespace assay::properties
