// Percentile bootstrap intervals of medians (Efron and Tibshirani, "An Introduction to the
// Bootstrap", 1993, section 13.3): the samples are drawn again with replacement many times, and
// the interval holds the middle 95 % of the medians of the draws.
//
// The intervals are deterministic: the draws come from the project's own integer random numbers,
// seeded alike for every call. They are narrower than the rank interval of estimate.h if samples
// are few, and lack its guarantee: with five samples the true coverage is nearer to 85 than to 95
// %.
#pragma once

#include "reports/bench/estimate.h"

namespace assay::reports {

// REQUIRES samples not empty. 2,000 draws: the ends are good to about 1 % of the interval's
// probability. O(2,000 n).
Estimate bootstrap_median(std::vector<double> samples);

// The same for the ratios a[i] / b[i] of measurements taken next to each other. REQUIRES equal
// sizes.
Estimate bootstrap_ratio(std::span<const double> a, std::span<const double> b);

// sum(a) / sum(b): a rate over items of very different size, such as cases. The interval comes
// from drawing items, and the samples are a[i] / b[i]. REQUIRES equal sizes.
Estimate bootstrap_ratio_of_sums(std::span<const double> a, std::span<const double> b);

}  // namespace assay::reports
