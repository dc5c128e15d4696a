// Checks laws where a crash of the detector does no harm. A law runs the built-in detector again,
// in this program; if that crashes, the law is broken, and all other checks go on.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/laws/law.h"

namespace assay::properties {

// Runs check(0) to check(count - 1), in this order, in a copy of this process. A check that ends
// the copy is broken: its tally says how the copy ended, and the next check begins a new copy. So
// whatever `check` keeps from one call to the next, it must be able to make again.
// case_of(i) is the id of the case that check i is about, for the words of a tally. Throws what
// `check` throws, and std::runtime_error if copies are killed from outside again and again. A copy
// costs some ten milliseconds, mostly for pages that both processes write, so whoever has many
// cases checks them together.
std::vector<LawTally> check_in_copies(std::size_t count,
                                      const std::function<std::string(std::size_t)>& case_of,
                                      const std::function<LawTally(std::size_t)>& check);

}  // namespace assay::properties
