// Finds the case of a trial for a detector with a contract.
#pragma once

#include <optional>
#include <string>

#include "properties/claims/contract.h"
#include "properties/generators/families.h"

namespace assay::properties {

// A case of a family, and what the contract takes of it.
struct PlannedCase {
  GeneratedCase made;
  // The case as the detector and the oracle are given it; nothing if no attempt led to a case that
  // the contract takes.
  std::optional<corpus::Case> seen;
  std::uint64_t redrawn = 0;         // cases before this one, which the contract does not take
  std::uint64_t steps_left_out = 0;  // steps of this case that the contract leaves out
};

// The case of a trial id. If the contract takes none of its steps, the next ids
// "quick:1:broken:3~1", "~2", ... are tried until it takes some, so that a stratum has as many
// judged cases under every contract. At most most_redrawn attempts are made, each deterministic.
// If the contract has a range of coordinates, the case is brought into it: it is scaled by a power
// of two until its largest coordinate fits, and coordinates that are too small become 0. Without a
// contract this is the case of the id.
inline constexpr std::uint64_t most_redrawn = 200;
PlannedCase case_within(const Contract& contract, const Family& family, const std::string& id);

// The case with its coordinates brought into the contract's range in this way.
corpus::Case brought_into_range(corpus::Case c, const Contract& contract);

}  // namespace assay::properties
