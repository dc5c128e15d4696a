// What a detector claims. It is judged by its claims and its contract alone.
#pragma once

#include <cstdint>
#include <vector>

#include "detector/options.h"
#include "properties/claims/contract.h"

namespace assay::properties {

// In the list below t* is the first contact time of the step. The contact graph at t* has the
// triangles as nodes, and the pairs that are in contact at t* as edges.
enum class Claim : std::uint8_t {
  free_sound,     // never `free` when the oracle has a contact
  not_late,       // lower end of its first time <= t*
  first_time,     // the interval of its first time holds t*
  first_pairs,    // every connected part of the contact graph at t* holds a reported pair
  all_pairs,      // every pair of the oracle is reported, none with a time after its own
  no_spurious,    // reports no contact that is not there, and none too early
  deterministic,  // the same input gives the same result
  total,          // every valid input within the limits is answered
  candidates,     // every pair of the oracle is among the candidate pairs of its broad phase
};

struct Claims {
  bool free_sound = false, not_late = false, first_time = false, first_pairs = false,
       all_pairs = false, no_spurious = false, deterministic = false, total = false,
       candidates = false;
  bool has(Claim claim) const;
  friend bool operator==(const Claims&, const Claims&) = default;
};

// The word of a claim in reports and certificates, such as "free-sound".
const char* name_of(Claim claim);

// In the order of Claim.
const std::vector<Claim>& all_claims();
// The claims that `claims` has, in the order of Claim.
std::vector<Claim> list_of(const Claims& claims);

// What the built-in detector claims. exact: everything. bounded: everything but no-spurious (its
// intervals hold the times by construction, see StepResult::first). double and float:
// deterministic and total. With pairs first, no arithmetic claims all-pairs.
Claims claims_of(const detector::Options& options);

// The claims that are judged under this contract. If it has a margin, no-spurious is not judged,
// because the detector may then report a collision before there is one. First-pairs and all-pairs
// are not judged of a detector that reports no pairs.
std::vector<Claim> judged_claims(const Claims& claims, const Contract& contract);

}  // namespace assay::properties
