// The case of a trial for a detector with a contract.
#pragma once

#include <optional>
#include <string>

#include "properties/claims/contract.h"
#include "properties/generators/families.h"

namespace assay::properties {

// A case of a family, and what the contract takes of it.
struct PlannedCase {
  GeneratedCase made;
  // As detector and oracle are given it; nothing where no attempt led to a case that the contract
  // takes.
  std::optional<corpus::Case> seen;
  std::uint64_t redrawn = 0;         // cases that the contract does not take, before this one
  std::uint64_t steps_left_out = 0;  // of this case
};

// The case of a trial id, or, where the contract takes none of its steps, the next one of the ids
// "quick:1:broken:3~1", "~2", ... of which it takes some: a stratum has as many judged cases
// within every contract. At most most_redrawn attempts, each deterministic. Where the contract has
// a range of coordinates, the case is brought into it: scaled by a power of two until its largest
// coordinate fits, and coordinates that are too small become 0. Without a contract: the case of
// the id, alone.
inline constexpr std::uint64_t most_redrawn = 200;
PlannedCase case_within(const Contract& contract, const Family& family, const std::string& id);

// The same case with its coordinates in the contract's range, as said above.
corpus::Case brought_into_range(corpus::Case c, const Contract& contract);

}  // namespace assay::properties
