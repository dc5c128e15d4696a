// Toy detectors with a planted fault. They take all contacts from the oracle and "miss" the
// contacts that the fault would lose. Also large meshes on which each fault shows.
#pragma once

#include <string>
#include <vector>

#include "properties/reducer/reducer.h"

namespace assay::properties::toys {

// The mesh from which the search for a failing case of a fault starts.
enum class Start { closed, nested_shells, tube_with_line, open };

struct ToyFault {
  std::string name;
  Judge judge;
  Start start = Start::closed;
  std::size_t vertices = 4;  // of the smallest known mesh
  std::string known;         // the curated case of the fault; "": only random motion finds it
};

const std::vector<ToyFault>& toy_faults();
const ToyFault& toy_fault(const std::string& name);

// Returns a case of about `triangles` triangles in which the fault shows. Draws a few meshes under
// random smooth motion with single jumps; if none shows the fault, inflates the curated case of the
// fault.
corpus::Case large_failing_case(const ToyFault& fault, int triangles, int steps,
                                std::uint64_t seed);

// Makes a large failing case from a small one, the reverse of a reduction. Splits faces and edges
// of `small`, adds noise to every position, and adds gentle steps before and after. A change is
// kept only if the case then fails with the same signature. Throws if `small` does not fail.
corpus::Case inflated_case(const corpus::Case& small, const Judge& judge, int triangles, int steps,
                           std::uint64_t seed);

}  // namespace assay::properties::toys
