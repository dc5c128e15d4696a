// What every variant of the detector takes for the same steps, and what it gets wrong: samples of
// steps, and their sums by family and by variant.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "detector/options.h"
#include "properties/judging/step_errors.h"
#include "reports/bench/cases.h"
#include "reports/bench/pictures.h"
#include "reports/estimate.h"

namespace assay::reports {

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

// One step by one variant: the time that it took, and what was wrong with the answer.
struct VariantStep {
  std::string family, kind, case_id;
  std::size_t step = 0;
  std::size_t triangles = 0;
  Variant variant;

  std::vector<double> ns;  // processor time, one sample for each round
  // The times of the reference on the same step, in the same rounds.
  std::vector<double> reference_ns;
  std::uint64_t hash = 0;  // hash of the result (result_hash)
  std::uint64_t box_tests = 0, candidates = 0, elementary_tests = 0;
  // All arithmetics are asked for what exact arithmetic would claim. Otherwise doubles, which
  // claim no pair, could miss none. Nothing is counted if the oracle was stopped at its time limit.
  properties::StepErrors errors;
};

// Runs a case through every variant, timed in turn (sweep_steps) and judged by the oracle. Culling
// none takes part up to 64 triangles, because every pair of a large mesh would take the suite's
// whole time.
//
// Adds a line to `wrong` if exact arithmetic differs from the oracle in anything, if bounded
// arithmetic misses or is late, or if two evaluations of one step differ. `tick` is called between
// evaluations.
std::vector<VariantStep> run_case(const CaseFamily& family, const TimedCase& timed,
                                  std::vector<std::string>& wrong,
                                  const std::function<void()>& tick);

// One variant on the steps of one family.
struct FamilySummary {
  std::string family, kind;
  Variant variant;
  std::uint64_t steps = 0;  // all that were timed, judged or not
  double triangles = 0;     // sum over steps
  std::uint64_t box_tests = 0, candidates = 0, elementary_tests = 0;  // sums over steps
  std::uint64_t hash = 0;                       // over the results of all steps, in order
  Estimate ns_a_step = {}, ns_a_triangle = {};  // medians over rounds, bootstrap intervals
  Estimate over_reference = {};                 // time over that of the reference, round by round
  properties::StepErrors errors = {};
};

// One variant on everything.
struct VariantSummary {
  Variant variant;
  Estimate over_reference;  // median of the families; interval by drawing families
  properties::StepErrors errors;
  // Of the judged steps. A variant is on the Pareto line of an error if no other one with the same
  // pairs is as fast and better. Culling none never is, because only the smallest meshes are run
  // with it.
  ShareOfSteps unsafe, alarming;
};

// In the order of families, then of variants. REQUIRES the steps of a family next to each other.
std::vector<FamilySummary> by_family(std::span<const VariantStep> steps);

// In the order of all_variants.
std::vector<VariantSummary> by_variant(std::span<const FamilySummary> families);

// The time of variant `of` over that of variant `over` on one family, round by round.
Estimate time_over(std::span<const FamilySummary> families, const std::string& family,
                   const Variant& of, const Variant& over);

// Adds the summaries to the report: the table of variants, the fields of the JSON, the samples of
// the CSV (a line for each step and variant, its times in ns separated by blanks: nothing is
// averaged) and the picture.
void add_figures(std::span<const VariantStep> steps, std::span<const FamilySummary> families,
                 std::span<const VariantSummary> variants, BenchReport& report);

// Speed against error, for detectors that are asked for all pairs. Across: the time of a step over
// that of the reference. Up: the share of unsafe steps, and of alarming ones.
std::string speed_error_picture(std::span<const VariantSummary> variants);

}  // namespace assay::reports
