// Medians of repeated measurements with intervals that need no model of their noise, ratios of
// interleaved measurements, quantiles. Rank intervals stand first, then intervals by the bootstrap.
// All of it is deterministic.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace assay::reports {

// A median with a rank interval. The ends are order statistics of the samples: the closest pair
// x_(k), x_(n+1-k) between which the true median lies with probability 95 % or more, whatever the
// distribution: 1 - 2 P(B < k) for B binomial (n, 1/2). Fewer than six samples cannot reach 95 %:
// the ends are then the least and the largest sample, which hold the median with probability 1 -
// 2^(1-n).
struct Estimate {
  double value = 0, lo = 0, hi = 0;
  std::vector<double> samples;  // raw, in the order in which they were taken
};

// REQUIRES samples not empty. The median of an even number of samples is the mean of the middle
// two.
Estimate median_of(std::vector<double> samples);

// An estimate for a figure that is counted and not sampled.
Estimate exactly(double value);

// The median of the ratios a[i] / b[i] of measurements that were taken next to each other, so that
// whatever slows a whole round down cancels. REQUIRES equal sizes.
Estimate ratio_of(std::span<const double> a, std::span<const double> b);

// The estimate times `factor`, for example to turn ns a mesh into ns a triangle.
Estimate scaled(Estimate estimate, double factor);

// The k of the rank interval for n samples, 1-based.
std::size_t rank_of_lower_end(std::size_t n);

// The value at rank ceil(share * n) of the sorted samples (nearest rank). REQUIRES samples not
// empty.
double quantile(std::vector<double> samples, double share);

// Percentile bootstrap intervals of medians (Efron and Tibshirani, "An Introduction to the
// Bootstrap", 1993, section 13.3): the samples are drawn again with replacement many times, and
// the interval holds the middle 95 % of the medians of the draws.
//
// The intervals are deterministic: the draws come from the project's own integer random numbers,
// seeded alike for every call. They are narrower than the rank interval of estimate.h if samples
// are few, and lack its guarantee: with five samples the true coverage is nearer to 85 than to 95
// %.

// REQUIRES samples not empty. 2,000 draws: the ends are good to about 1 % of the interval's
// probability. O(2,000 n).
Estimate bootstrap_median(std::vector<double> samples);

// The same for the ratios a[i] / b[i] of measurements taken next to each other. REQUIRES equal
// sizes.
Estimate bootstrap_ratio(std::span<const double> a, std::span<const double> b);

}  // namespace assay::reports
