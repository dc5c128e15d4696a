// Finds the case of a trial for a detector with a contract.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/claims/claims.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/judging/trial.h"

namespace assay::properties {

// A case of a family, and what the contract takes of it.
struct PlannedCase {
  GeneratedCase made;
  // The case as the detector and the oracle are given it; nothing if no attempt led to a case that
  // the contract takes.
  std::optional<corpus::Case> seen;
  std::uint64_t redrawn = 0;         // cases before this one, which did not serve
  std::uint64_t steps_left_out = 0;  // steps of this case that the contract leaves out
};

// The case of a trial id. If the contract takes none of its steps, the next ids
// "quick:1:broken:3~1", "~2", ... are tried until it takes some, so that a stratum has as many
// judged cases under every contract. Of a query, and under a contract that leaves contacts out,
// every fourth case has to have a contact that counts, and is drawn again until it has one. At most
// most_redrawn attempts are made, each deterministic; of them at most most_without_contact on cases
// that the contract takes, and then the last of these stays. The case is brought into the contract
// (below). Under a contract with a separation every second case is aimed at that (added_bodies.h),
// and a case of which every step starts within it does not serve. Without a contract this is, of a
// mesh, the case of the id.
inline constexpr std::uint64_t most_redrawn = 200, most_without_contact = 40;
PlannedCase case_within(const Contract& contract, const Family& family, const std::string& id);

// The case scaled by a power of two, so that the contract may take it. Its features can hardly lie
// start_distance apart if the whole mesh is smaller than eight times that, so it becomes that
// large, if a range of the contract allows it. With a separation the mesh becomes twice to 512
// times as large as that. Of a mesh of more than 400 triangles the middle one of its edges is
// looked at in place of the mesh, and becomes twice to 8 times as large as the separation. If the
// contract has a range, the case is scaled until its largest coordinate fits, or until its shortest
// edge does.
corpus::Case brought_into_contract(corpus::Case c, const Contract& contract);

// Finds the cases for which Start::clean may be used, because what the caller then vouches for is
// true.

// Whether the oracle calls every triangle clean (L9, detector/LAWS.md) in every step of the case
// that is a new start. For an unclosed mesh that depends on where the built-in detector puts its
// apexes, so it is asked for them, in a copy of this process, in which a crash does no harm.
bool starts_clean(const corpus::Case& c);

// Whether trial `index` of a family vouches for the start of its case. That is done for the
// built-in detector, in every second one of the trials that may. A large mesh is not looked at.
bool is_vouched_for(const DetectorUnderTest& detector, const corpus::Case& c, std::uint64_t index);

// The same configurations, with start clean in place of start verified.
std::vector<Configuration> with_clean_start(std::vector<Configuration> configurations);

}  // namespace assay::properties
