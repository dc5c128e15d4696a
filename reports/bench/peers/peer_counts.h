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

// First times on one side of the exact one, by their lower ends: a user goes up to there.
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

// Where not said otherwise, steps that the contract takes.
struct PeerCounts {
  std::uint64_t steps = 0;
  std::uint64_t left_out = 0;   // steps that it does not take
  std::uint64_t contact = 0;    // with a contact that counts
  std::uint64_t undecided = 0;  // without an answer: undecided, an error, hung, crashed
  // `free` against a contact; a time late by more than is tolerated; a pair missing that is asked.
  std::uint64_t unsafe = 0;
  std::uint64_t missed = 0;     // of these, `free` against a contact
  std::uint64_t confirmed = 0;  // of `unsafe`, by another method than the oracle (confirmation.h)
  std::uint64_t false_alarms = 0;
  std::uint64_t missing = 0, spurious = 0;  // pairs
  std::uint64_t timed_collisions = 0;       // answered with a time that says something
  PeerTimes late, early;                    // by more than is tolerated

  std::uint64_t free() const { return steps - contact; }
  void add(const PeerCounts& other);
};

// A step whose answer was unsafe.
struct UnsafeAnswer {
  std::string detector, case_id;
  std::size_t step = 0;  // of those that the contract takes
  std::string what;      // "missed", "late", "pairs missing"
  bool is_confirmed = false;
};

// Of a case, as the contract has it; `run` is the first of its runs. Adds to `unsafe`.
PeerCounts counts_of(const PeerSubject& subject, const corpus::Case& seen,
                     const properties::CaseRun& run,
                     const std::vector<oracle::StepJudgement>& truth,
                     std::vector<UnsafeAnswer>& unsafe);

}  // namespace assay::reports
