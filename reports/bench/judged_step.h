// One step by one variant of the detector: the time that it took, and what was wrong with the
// answer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/options.h"

namespace assay::reports {

inline constexpr auto every_arithmetic = all_values<detector::Arithmetic>;

// An assembly that a user may choose by options.
struct Variant {
  detector::Arithmetic arithmetic = detector::Arithmetic::exact;
  detector::Culling culling = detector::Culling::bvh;
  detector::Pairs pairs = detector::Pairs::all;
  friend bool operator==(const Variant&, const Variant&) = default;
};

// The variant that all others are measured against: exact, bvh, all pairs.
inline constexpr Variant reference_variant{};

// Every arithmetic with every culling, for all pairs and for first pairs. Culling none is among
// them only if `with_none` is set. The reference is the first.
std::vector<Variant> all_variants(bool with_none);

// "exact view-auto all"
std::string name_of(const Variant& variant);

// How far a reported first time is from the oracle's: properties::TimeOff with a tolerance of 0,
// and the same in doubles. At most one of late and early is not 0.
struct FirstTimeError {
  double late_ulps = 0, early_ulps = 0;    // doubles between the two times
  double late_share = 0, early_share = 0;  // as shares of the step
};
FirstTimeError first_time_error(const detector::TimeEnclosure& reported,
                                const detector::TimeEnclosure& truth);

struct JudgedStep {
  std::string family, kind;  // kind: scene, generated, hard, real
  std::string case_id;
  std::size_t step = 0;
  std::size_t triangles = 0;
  Variant variant;

  std::vector<double> ns;  // processor time, one sample for each round
  // The times of the reference on the same step, in the same rounds.
  std::vector<double> reference_ns;
  std::uint64_t hash = 0;  // hash of the result (result_hash)
  std::uint64_t box_tests = 0, candidates = 0, elementary_tests = 0;

  // The rest compares the answer with the oracle's. `judged` is false if the oracle was stopped at
  // its time limit.
  bool judged = true;
  bool contact = false;                   // the oracle has a contact
  bool missed = false;                    // `free`, although there is a contact
  bool false_alarm = false;               // `collision`, although there is no contact
  std::size_t missing = 0, spurious = 0;  // pairs; of the missing ones those that are claimed
  FirstTimeError first;                   // if both have a contact

  // A user would run into this: a contact or a pair is not reported, or is reported too late.
  bool unsafe() const { return missed || missing > 0 || first.late_ulps > 0; }
  // A user would look for this in vain: a contact or a pair is reported that is not there.
  bool alarming() const { return false_alarm || spurious > 0; }
};

}  // namespace assay::reports
