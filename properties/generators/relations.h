// Relations between pairs for random cases: which pairs count (detector/mesh/counted_pairs.h).
#pragma once

#include <span>

#include "detector/mesh/enum_names.h"
#include "properties/generators/draft.h"

namespace assay::properties {

// Gives the case a relation that leaves something out: bodies, which are its components, of which
// some do not meet; one or two rings; a distance at rest of the order of an edge, at rest as in the
// first frame. It is one of triangles or of features.
void add_relation(Random& random, GeneratedCase& made);

// What a relation leaves out, one thing alone.
enum class LeftOut : std::uint8_t { nothing, bodies, rings, near_at_rest, single_pairs };
constexpr auto names_of(LeftOut) {
  using enum LeftOut;
  return std::to_array<Named<LeftOut>>({{nothing, "nothing"},
                                        {bodies, "bodies"},
                                        {rings, "rings"},
                                        {near_at_rest, "near at rest"},
                                        {single_pairs, "single pairs"}});
}

// A relation of triangles, or now and then of features, that leaves this out of the case: of
// `in_contact` about every second pair, or a pair of features of it; what is nearer than a length
// between an edge and 2^-10 of it, with one of the frames at rest. REQUIRES that something is left
// out.
detector::CountedPairs relation_without(LeftOut left_out, Random& random, const corpus::Case& c,
                                        std::span<const detector::PairContact> in_contact);

}  // namespace assay::properties
