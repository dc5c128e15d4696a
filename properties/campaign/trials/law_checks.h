// Checks laws where a crash of the detector does no harm. A law runs the built-in detector again,
// in this program; if that crashes, the law is broken, and all other checks go on.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "properties/laws/law.h"

namespace assay::properties {

// Runs check(0) to check(count - 1), in this order, in a copy of this process. A check that ends
// the copy is broken: its tally says how the copy ended, and the next check begins a new copy. So
// whatever `check` keeps from one call to the next, it must be able to make again.
// case_id: for the words of a tally. Throws what `check` throws, and std::runtime_error if copies
// are killed from outside again and again.
std::vector<LawTally> check_in_copies(std::string_view case_id, std::size_t count,
                                      const std::function<LawTally(std::size_t)>& check);

}  // namespace assay::properties
