// Random steps with a relation that says which pairs count (L19), and whether a plain loop over all
// pairs of triangles (plain_contacts.h), the oracle and the detector agree on them.
//
// Coordinates are small integers, so that degenerate contacts and distances that equal the limit
// are frequent. A mesh has one to three parts, closed, a tube, open or a sheet; some of them stand
// still. Two steps follow each other, so that what the first has left in a state serves the second.
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

// Case `index` of `seed`, which a hash of both makes alone. Every kind of relation, alone and with
// others, at both levels.
CountedSteps make_counted_steps(std::uint64_t seed, std::uint64_t index);

// What was seen, beside agreement.
struct CountedTally {
  std::uint64_t steps = 0, collisions = 0, pairs = 0;
  std::uint64_t ignored = 0;  // pairs in contact that do not count
  // Steps in which some do not count; and among these steps with others that do.
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

// The first disagreement between the plain loop, the oracle and the detector with several cullings,
// in words; nothing if all agree. With `pairs` first the answer, the first time and that all pairs
// are contacts that count.
std::optional<std::string> disagreement(const CountedSteps& steps, CountedTally& tally);

// The same for what comes within a separation above 0, of the oracle, its least distance and the
// detector.
std::optional<std::string> disagreement_within(const CountedSteps& steps, double separation,
                                               CountedTally& tally);

}  // namespace assay::properties::test
