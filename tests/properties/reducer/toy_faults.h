// Detectors with a planted fault, written over the oracle: they know all contacts and "miss" those
// that the fault would lose. And large meshes on which each fault shows.
#pragma once

#include <string>
#include <vector>

#include "properties/reducer/reducer.h"

namespace assay::properties::toys {

// What a fault starts from.
enum class Start { closed, nested_shells, tube_with_line, open };

struct ToyFault {
  std::string name;
  Judge judge;
  Start start = Start::closed;
  std::size_t vertices = 4;  // of the smallest mesh known
  std::string known;         // the curated case that has it; none: found by random motion alone
};

const std::vector<ToyFault>& toy_faults();
const ToyFault& toy_fault(const std::string& name);

// Meshes of about `triangles` triangles under random smooth motion with single jumps: the first in
// which the fault shows, or after a few the curated case of the fault, inflated.
corpus::Case large_failing_case(const ToyFault& fault, int triangles, int steps,
                                std::uint64_t seed);

// Large failing cases from small ones, the reverse of a reduction. Splits faces and edges of
// `small`, adds noise to every place, and puts gentle steps before and behind it, keeping only what
// fails with the same signature. Throws when `small` holds.
corpus::Case inflated_case(const corpus::Case& small, const Judge& judge, int triangles, int steps,
                           std::uint64_t seed);

}  // namespace assay::properties::toys
