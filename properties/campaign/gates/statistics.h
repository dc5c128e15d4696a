// Bounds on the share of failures that trials support.
#pragma once

#include <cstdint>

namespace assay::properties {

// With which all bounds of a certificate hold together.
inline constexpr double family_confidence = 0.95;

// The exact one-sided upper bound of Clopper and Pearson (Biometrika 26, 1934): the largest share
// p at which at most `failures` of `trials` still has a chance of `risk` or more. 1 without
// trials.
double upper_bound(std::uint64_t failures, std::uint64_t trials, double risk);

// Where a share lies with confidence 95 %: `of` of `in`, of which only `independent` are worth
// counting, since the others hang together with them. Clopper and Pearson's interval, both ends;
// the numbers may be fractions. [0, 1] without any.
struct ShareInterval {
  double lo = 0, hi = 1;
};
ShareInterval share_interval(double of, double in, double independent);

// The risk of one of `bounds` bounds that hold together with confidence 95 % (Bonferroni).
double risk_of_each(std::uint64_t bounds);

}  // namespace assay::properties
