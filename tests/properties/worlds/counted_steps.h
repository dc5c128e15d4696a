// Random steps with a relation that says which pairs count (L19), and checks that a plain loop over
// all pairs of triangles (plain_contacts.h), the oracle and the detector agree on these steps.
//
// Coordinates are small integers, so that degenerate contacts and distances that equal the limit
// are frequent. A mesh has one to three parts. Each part is a closed mesh, a tube, an open mesh or
// a sheet, and some parts rest. Each case has two steps, so that the second step uses the state
// that the first step left.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "detector/mesh/counted_pairs.h"
#include "detector/step_result.h"
#include "oracle/mesh/step.h"

namespace assay::properties::test {

struct CountedSteps {
  detector::Triangles triangles;
  std::vector<detector::Positions> frames;  // three: two steps
  detector::CountedPairs counted;
};

// Makes case `index` of `seed` from a hash of these two numbers alone. The cases have every kind of
// relation, alone and together with other kinds, about triangles and about features.
CountedSteps make_counted_steps(std::uint64_t seed, std::uint64_t index);

// Counts of the steps and pairs that were compared.
struct CountedTally {
  std::uint64_t steps = 0, collisions = 0, pairs = 0;
  std::uint64_t ignored = 0;  // pairs in contact that do not count
  // Steps in which some pairs in contact do not count; steps in which, besides, some pairs do
  // count.
  std::uint64_t with_ignored = 0, with_both = 0;

  void add(std::size_t counted, std::size_t in_contact) {
    ++steps;
    collisions += counted > 0;
    pairs += counted;
    ignored += in_contact - counted;
    with_ignored += in_contact > counted;
    with_both += in_contact > counted && counted > 0;
  }
};

// Returns the first disagreement between the plain loop, the oracle and the detector with several
// cullings; nothing if all agree. With Pairs::first it compares the answer and the first time, and
// checks that every reported pair is a contact that counts.
std::optional<std::string> disagreement(const CountedSteps& steps, CountedTally& tally);

// Returns the first disagreement about the pairs that come within a separation above 0, between the
// oracle, its least distance and the detector.
std::optional<std::string> disagreement_within(const CountedSteps& steps, double separation,
                                               CountedTally& tally);

}  // namespace assay::properties::test
