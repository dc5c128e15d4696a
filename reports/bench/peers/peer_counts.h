// What one detector had right and wrong, by the oracle and under its own contract.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "oracle/mesh/step.h"
#include "properties/judging/judged_run.h"
#include "reports/bench/peers/peer_subject.h"

namespace assay::reports {

// First times that are off on one side of the exact one (properties::TimeOff).
struct PeerTimes {
  std::uint64_t steps = 0;
  double worst = 0;  // share of the step

  void add(double share) {
    ++steps;
    worst = std::max(worst, share);
  }
  void add(const PeerTimes& other) {
    steps += other.steps;
    worst = std::max(worst, other.worst);
  }
};

// Numbers are of steps that the contract takes, unless said otherwise.
struct PeerCounts {
  std::uint64_t steps = 0;
  std::uint64_t left_out = 0;   // steps that it does not take
  std::uint64_t contact = 0;    // steps with a contact that counts
  std::uint64_t undecided = 0;  // steps without an answer: undecided, an error, hung, crashed
  // The answer is `free` although there is a contact, the first time is late by more than is
  // tolerated, or a pair is missing although pairs are asked for.
  std::uint64_t unsafe = 0;
  std::uint64_t missed = 0;     // of `unsafe`: `free`, although there is a contact
  std::uint64_t confirmed = 0;  // of `unsafe`: confirmed without the oracle (confirmation.h)
  std::uint64_t false_alarms = 0;
  std::uint64_t missing = 0, spurious = 0;  // pairs
  std::uint64_t timed_collisions = 0;       // collisions with another first time than [0, 1]
  PeerTimes late, early;                    // off by more than is tolerated

  std::uint64_t free() const { return steps - contact; }
  void add(const PeerCounts& other);
};

// A step whose answer was unsafe.
struct UnsafeAnswer {
  std::string detector, case_id;
  std::size_t step = 0;  // number among the steps that the contract takes
  std::string defect;    // "missed", "late", "pairs missing"
  bool is_confirmed = false;
};

// The counts of one case. `seen` is the case as the contract has it, `run` the first of its runs.
// Adds to `unsafe`.
PeerCounts counts_of(const PeerSubject& subject, const corpus::Case& seen,
                     const properties::CaseRun& run,
                     const std::vector<oracle::StepJudgement>& truth,
                     std::vector<UnsafeAnswer>& unsafe);

}  // namespace assay::reports
