// Bounds on the share of failures that trials support.
#pragma once

#include <cstdint>

namespace assay::properties {

// With which all bounds of a certificate hold together.
inline constexpr double family_confidence = 0.95;

// The exact one-sided upper bound of Clopper and Pearson (Biometrika 26, 1934): the largest share p
// at which at most `failures` of `trials` still has a chance of `risk` or more. 1 without trials.
double upper_bound(std::uint64_t failures, std::uint64_t trials, double risk);

// The risk of one of `bounds` bounds that hold together with confidence 95 % (Bonferroni).
double risk_of_each(std::uint64_t bounds);

}  // namespace assay::properties
