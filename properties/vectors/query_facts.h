// What is exactly true of one query: two features over a step, be they alone or in a mesh.
#pragma once

#include <set>

#include "detector/mesh/step_types.h"
#include "properties/vectors/vectors.h"

namespace assay::properties {

// Of a contact; `pairs` stay empty. The features pass, and so the result is `collision`, if at some
// time inside of the step they meet while F changes its sign; else they touch.
VectorFacts contact_facts(const detector::FourPoints& query);

// Of coming within d. They only come to d itself if nothing is within d less a 2^60th of it.
VectorFacts distance_facts(const detector::FourPoints& query, double d);

// The vector of a query with its facts, flags and hardness. REQUIRES a case that is a query.
// `distance`: that which is asked about; 0: a contact is.
Vector query_vector(corpus::Case c, double distance, VectorPrecision precision);

// REQUIRES the facts of the query. `distance`: that which was asked about; 0: a contact was.
std::set<VectorFlag> flags_of(const detector::FourPoints& query, const VectorFacts& facts,
                              double distance, VectorPrecision precision);
// The flags that go by coordinates alone.
std::set<VectorFlag> number_flags_of(std::span<const detector::MovingPoint> points,
                                     VectorPrecision precision);

// How near the query is to a degeneracy at the time of its contact; without a contact, and of a
// question about distance, how near the least distance is to what is asked about.
VectorHardness hardness_of(const detector::FourPoints& query, const VectorFacts& facts,
                           double distance);

}  // namespace assay::properties
