// One step by one variant of the detector: what it took, and what was wrong with the answer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/options.h"

namespace assay::reports {

inline constexpr detector::Arithmetic every_arithmetic[] = {
    detector::Arithmetic::exact, detector::Arithmetic::bounded,
    detector::Arithmetic::double_precision, detector::Arithmetic::single_precision};

// An assembly that a user may choose by options.
struct Variant {
  detector::Arithmetic arithmetic = detector::Arithmetic::exact;
  detector::Culling culling = detector::Culling::bvh;
  detector::Pairs pairs = detector::Pairs::all;
  friend bool operator==(const Variant&, const Variant&) = default;
};

// What all others are measured against: exact, bvh, all pairs.
inline constexpr Variant reference_variant{};

// Every arithmetic, every culling, all pairs and first; culling none where `with_none`. The
// reference is the first.
std::vector<Variant> all_variants(bool with_none);

// "exact view-auto all"
std::string name_of(const Variant& variant);

// How far a reported first time is from the oracle's, both by their lower ends: that is the time
// up to which a user would go. At most one of late and early is not 0.
struct FirstTimeError {
  double late_ulps = 0, early_ulps = 0;    // doubles between the two times
  double late_share = 0, early_share = 0;  // of the step
};
FirstTimeError first_time_error(const detector::TimeEnclosure& reported,
                                const detector::TimeEnclosure& truth);

struct JudgedStep {
  std::string family, kind;  // kind: scene, generated, hard, real
  std::string case_id;
  std::size_t step = 0;
  std::size_t triangles = 0;
  Variant variant;

  std::vector<double> ns;  // processor time, a sample a round
  // Of the reference on the same step in the same round.
  std::vector<double> reference_ns;
  std::uint64_t hash = 0;  // of the result, see result_hash
  std::uint64_t box_tests = 0, candidates = 0, elementary_tests = 0;

  // Against the oracle. Not judged: the oracle was stopped at its time limit.
  bool judged = true;
  bool contact = false;                   // by the oracle
  bool missed = false;                    // `free` against a contact
  bool false_alarm = false;               // `collision` against none
  std::size_t missing = 0, spurious = 0;  // pairs; missing ones that are claimed
  FirstTimeError first;                   // where both have a contact

  // What a user would run into: a contact or a pair is not told, or told too late.
  bool unsafe() const { return missed || missing > 0 || first.late_ulps > 0; }
  // What a user would look for in vain: contacts or pairs that there are not.
  bool alarming() const { return false_alarm || spurious > 0; }
};

}  // namespace assay::reports
