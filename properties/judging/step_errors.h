// How wrong the answers of a detector were: the one account of it, for a step or summed over many.
// Campaigns, `check` and all benches count with it, so that each of its words has one meaning.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "properties/fields.h"
#include "properties/judging/agreement.h"

namespace assay::properties {

// First times that are off on one side of the exact one (TimeOff, agreement.h).
struct TimesOff {
  std::uint64_t steps = 0;
  double worst_share = 0;  // of a step
  double worst_ulps = 0;
  // How often each share of a step was met, for quantiles. A share is rounded upward to two digits
  // (0.00012), so that no time is said to be better than it is, and sums stay short.
  std::map<double, std::uint64_t> shares;

  // The rounded share at this part of the values in ascending order: 0.5 is the median, and 1 the
  // worst. 0 if there is none.
  double quantile(double part) const;

  TimesOff& operator+=(const TimesOff& other);
  friend bool operator==(const TimesOff&, const TimesOff&) = default;
};

// How a limiter uses what is possible, over the steps that start without a contact.
struct LimitUse {
  std::uint64_t free = 0;     // steps without any contact
  std::uint64_t cut = 0;      // of `free`: not gone to their end
  std::uint64_t contact = 0;  // steps with a contact ahead
  TimesOff unused;            // of `contact`: the share of the time until it that was not used
  // Of `contact`: less than what is claimed was used, and rounding may be why (judge_limit).
  std::uint64_t excused = 0;
  std::map<std::string, std::uint64_t> stalls;  // of `contact`, by their cause (LimitDiff::stall)

  // The share that was used of the time until the contact, at this part of the steps in ascending
  // order: 0 is the worst, 0.5 the median. REQUIRES contact > 0.
  double used(double part) const;
  std::uint64_t stalled() const;

  LimitUse& operator+=(const LimitUse& other);
  friend bool operator==(const LimitUse&, const LimitUse&) = default;
};

// Steps that the oracle did not finish are not counted at all. A step without an answer is counted
// in `steps` and `undecided` alone, so that all other numbers are of answered steps. Contacts are
// those that count under the contract.
struct StepErrors {
  std::uint64_t steps = 0;
  std::uint64_t undecided = 0;     // neither `free` nor `collision`: undecided, an error, no run
  std::uint64_t free = 0;          // nothing is in contact, not even what the contract leaves out
  std::uint64_t contact = 0;       // something that counts is in contact
  std::uint64_t missed = 0;        // of `contact`: answered `free`
  std::uint64_t false_alarms = 0;  // of `free`: answered `collision`
  // Of the steps with a contact that were answered `collision`: the first time is after the exact
  // one, or before it, by more than the contract tolerates.
  TimesOff late, early;
  // Steps that would hurt a user who trusts the answer: missed, or late, or with a missing pair of
  // a detector that claims pairs.
  std::uint64_t unsafe = 0;
  // Steps that would let a user look in vain: a false alarm, or a spurious pair.
  std::uint64_t alarming = 0;
  // Pairs. Missing: in contact, asked for by the claims, and not reported. Spurious: reported, and
  // not in contact.
  std::uint64_t missing = 0, spurious = 0;
  LimitUse limits;  // counted whatever is claimed, and for steps without an answer too

  std::uint64_t answered() const { return steps - undecided; }
  std::uint64_t collisions() const { return contact - missed; }  // of `contact`

  StepErrors& operator+=(const StepErrors& other);
  friend bool operator==(const StepErrors&, const StepErrors&) = default;
};

// Those of one step.
StepErrors errors_of(const StepDiff& diff);

// {"steps": 3, ..., "late": {"steps": 1, "worst_share": 0.00012, ...}, ...}: every member by its
// name. Most detectors are no limiters, and have no object `limits`.
void to_json(nlohmann::ordered_json& json, const StepErrors& errors);

ASSAY_FIELDS(TimesOff, steps, worst_share, worst_ulps, shares)
ASSAY_FIELDS(LimitUse, free, cut, contact, unused, excused, stalls)

template <class Archive>
void fields(Archive& archive, StepErrors& errors) {
  auto& [steps, undecided, free, contact, missed, false_alarms, late, early, unsafe, alarming,
         missing, spurious, limits] = errors;
  archive("steps", steps, "undecided", undecided, "free", free, "contact", contact);
  archive("missed", missed, "false_alarms", false_alarms, "late", late, "early", early);
  archive("unsafe", unsafe, "alarming", alarming, "missing", missing, "spurious", spurious);
  archive.may("limits", limits);
}

}  // namespace assay::properties
