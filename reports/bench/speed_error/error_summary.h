// Sums up the judged steps of suite speed-error: by family and variant, and by variant over all
// families.
#pragma once

#include <span>

#include "reports/bench/estimate.h"
#include "reports/bench/judged_step.h"

namespace assay::reports {

// How far first times are off on one side of the truth, over the steps whose time is off on that
// side.
struct TimeErrors {
  std::size_t steps = 0;
  double median_ulps = 0, largest_ulps = 0;
  double median_share = 0, largest_share = 0;  // shares of the step
};

struct ErrorCounts {
  std::size_t steps = 0, judged = 0, contact = 0;  // contact: by the oracle
  std::size_t unsafe = 0, alarming = 0;            // judged steps (JudgedStep)
  std::size_t missed = 0, false_alarms = 0;        // steps
  std::size_t missing = 0, spurious = 0;           // pairs
  TimeErrors late, early;
};

// One variant on the steps of one family.
struct FamilySummary {
  std::string family, kind;
  Variant variant;
  double triangles = 0;                                        // sum over steps
  double box_tests = 0, candidates = 0, elementary_tests = 0;  // sums over steps
  std::uint64_t hash = 0;                       // over the results of all steps, in order
  Estimate ns_a_step = {}, ns_a_triangle = {};  // medians over rounds, bootstrap intervals
  Estimate over_reference = {};                 // time over that of the reference, round by round
  ErrorCounts errors = {};
};

// A share of the judged steps, with its interval of Clopper and Pearson, 95 %.
struct ShareOfSteps {
  double share = 0, lo = 0, hi = 0;
  bool on_pareto_line = false;  // no variant with the same pairs is as fast and better
};

ShareOfSteps share_of(std::size_t part, std::size_t all);

// One variant on everything.
struct VariantSummary {
  Variant variant;
  Estimate over_reference;  // median of the families; interval by drawing families
  ErrorCounts errors;
  ShareOfSteps unsafe, alarming;
};

// In the order of families, then of variants. REQUIRES `steps` not empty.
std::vector<FamilySummary> by_family(std::span<const JudgedStep> steps);

// In the order of all_variants. `families` are what by_family made of `steps`.
std::vector<VariantSummary> by_variant(std::span<const JudgedStep> steps,
                                       std::span<const FamilySummary> families);

// The variants with these `pairs` that no other variant beats in speed and error at once: fastest
// first, each with a smaller share of errors than all that are faster. Culling none is left out,
// because only the smallest meshes are run with it.
std::vector<VariantSummary> pareto_line(std::span<const VariantSummary> summaries,
                                        detector::Pairs pairs, ShareOfSteps VariantSummary::*error);

// The time of variant `of` over that of variant `over` on one family, round by round.
Estimate time_over(std::span<const FamilySummary> families, const std::string& family,
                   const Variant& of, const Variant& over);

}  // namespace assay::reports
