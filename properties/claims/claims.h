// What a detector claims of its answers.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "detector/options.h"
#include "properties/claims/contract.h"

namespace assay::properties {

// In the list below t* is the first contact time of the step; under a contract with a separation d
// it is the first time within d, and a contact is a pair that comes within d. The contact graph at
// t* has the triangles as nodes, and the pairs that are in contact at t* as edges.
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
  // Of a limiter (L17), in steps that start without a contact.
  commit_free,  // the step to the positions that it allows has no contact
  path_free,    // the share that it allows is below t*
  progress,     // that share is Contract::progress of what is possible or more (judge_limit)
  whole,        // it allows a step without a contact to its very end
  // Every time is the enclosure of exact arithmetic, so it has to be the oracle's in every bit.
  // This is how the other claims on times are read of a detector that claims it. Only the built-in
  // detector does: nobody claims it from outside, and no list names it.
  times_unique,
};
constexpr auto names_of(Claim) {
  using enum Claim;
  return std::to_array<Named<Claim>>({{free_sound, "free-sound"},
                                      {not_late, "not-late"},
                                      {first_time, "first-time"},
                                      {first_pairs, "first-pairs"},
                                      {all_pairs, "all-pairs"},
                                      {no_spurious, "no-spurious"},
                                      {deterministic, "deterministic"},
                                      {total, "total"},
                                      {candidates, "candidates"},
                                      {commit_free, "commit-free"},
                                      {path_free, "path-free"},
                                      {progress, "progress"},
                                      {whole, "whole-when-safe"},
                                      {times_unique, "times-unique"}});
}

// A set of claims.
class Claims {
 public:
  constexpr Claims() = default;
  constexpr Claims(std::initializer_list<Claim> claims) {
    for (const Claim claim : claims) bits_ |= bit_of(claim);
  }
  static constexpr Claims of_bits(std::uint32_t bits) {
    Claims claims;
    claims.bits_ = bits;
    return claims;
  }

  constexpr std::uint32_t bits() const { return bits_; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr bool has(Claim claim) const { return (bits_ & bit_of(claim)) != 0; }
  constexpr bool has_any(const Claims& others) const { return (bits_ & others.bits_) != 0; }
  constexpr Claims& set(Claim claim, bool is_claimed = true) {
    bits_ = is_claimed ? bits_ | bit_of(claim) : bits_ & ~bit_of(claim);
    return *this;
  }
  // Those of them that are also among the others, and those that are not.
  constexpr Claims only(const Claims& others) const { return of_bits(bits_ & others.bits_); }
  constexpr Claims without(const Claims& others) const { return of_bits(bits_ & ~others.bits_); }
  constexpr Claims with(const Claims& others) const { return of_bits(bits_ | others.bits_); }

  friend constexpr bool operator==(const Claims&, const Claims&) = default;

 private:
  static constexpr std::uint32_t bit_of(Claim claim) { return 1u << static_cast<unsigned>(claim); }
  std::uint32_t bits_ = 0;
};

// Those that only a limiter can make.
inline constexpr Claims claims_on_limits = {Claim::commit_free, Claim::path_free, Claim::progress,
                                            Claim::whole};

// Those that a detector may claim from outside. Their numbers are the bits of
// assay_description::claims (detector/plugin/assay_detector.h).
inline constexpr Claims claims_from_outside =
    Claims::of_bits((1u << static_cast<unsigned>(Claim::times_unique)) - 1);

// Those of claims_from_outside that `claims` has, in the order of Claim; and all of them.
std::vector<Claim> list_of(const Claims& claims);
std::vector<Claim> all_claims();

// What the built-in detector claims. exact: everything. bounded: everything but no-spurious (its
// intervals hold the times by construction, see StepResult::first). double and float:
// deterministic and total. With pairs first, no arithmetic claims all-pairs.
Claims claims_of(const detector::Options& options);

// The progress that the built-in detector promises where it limits a step.
inline constexpr double built_in_progress = 0.9;

// What the built-in detector is asked with these options: contact, or within a separation of pairs
// that share no vertex.
Contract contract_of(const detector::Options& options);

// The claims that are judged under this contract. If it has a margin, first-time is not judged,
// because the detector may then report a collision before there is one; no-spurious is judged with
// the margin of queries, and of steps if the detector leaves neighbours out. First-pairs and
// all-pairs are not judged of a detector that reports no pairs.
Claims judged_claims(const Claims& claims, const Contract& contract, bool of_queries = false);

}  // namespace assay::properties
