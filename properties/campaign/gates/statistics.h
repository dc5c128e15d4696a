// Bounds on the share of failures that trials support.
#pragma once

#include <cstdint>

namespace assay::properties {

// The confidence with which all bounds of a certificate hold together.
inline constexpr double family_confidence = 0.95;

// The exact one-sided upper bound of Clopper and Pearson (Biometrika 26, 1934): the largest share
// p at which at most `failures` of `trials` still has a chance of `risk` or more. 1 without
// trials.
double upper_bound(std::uint64_t failures, std::uint64_t trials, double risk);

// The interval in which a share lies with confidence 95 %. `of` out of `in` trials count for the
// share, but only `independent` of the `in` are worth counting, because the others depend on
// these. It is the interval of Clopper and Pearson with both ends; the numbers may be fractions.
// [0, 1] if there are none.
struct ShareInterval {
  double lo = 0, hi = 1;
};
ShareInterval share_interval(double of, double in, double independent);

// The risk of each of `bounds` bounds so that all hold together with confidence 95 % (Bonferroni).
double risk_of_each(std::uint64_t bounds);

}  // namespace assay::properties
