// Medians of repeated measurements with intervals that need no model of their noise, ratios of
// interleaved measurements, quantiles, and exponents of growth. Deterministic: nothing is
// resampled.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace assay::reports {

// A median with a rank interval: its ends are order statistics of the samples, the closest pair
// x_(k), x_(n+1-k) between which the true median lies with probability 95 % or more, whatever the
// distribution: 1 - 2 P(B < k) for B binomial (n, 1/2). Fewer than six samples reach no 95 %: the
// ends are then the least and the largest, which hold the median with probability 1 - 2^(1-n).
struct Estimate {
  double value = 0, lo = 0, hi = 0;
  std::vector<double> samples;  // raw, in the order in which they were taken
};

// samples must not be empty. The median of an even number is the mean of the middle two.
Estimate median_of(std::vector<double> samples);

// A figure that is counted, not sampled.
Estimate exactly(double value);

// Median of the ratios a[i] / b[i] of measurements taken next to each other: what slows a round
// down as a whole cancels. Same sizes.
Estimate ratio_of(std::span<const double> a, std::span<const double> b);

// Times `factor`, such as ns a mesh to ns a triangle.
Estimate scaled(Estimate estimate, double factor);

// The k of the rank interval for n samples, 1-based.
std::size_t rank_of_lower_end(std::size_t n);

// The value at rank ceil(share * n) of the sorted samples (nearest rank); samples not empty.
double quantile(std::vector<double> samples, double share);

// Least squares y = intercept + slope * x; at least two different x.
struct Line {
  double intercept = 0, slope = 0;
};
Line fit_line(std::span<const double> x, std::span<const double> y);

// The e of time ~ size^e: the slope of log time over log size.
double growth_exponent(std::span<const double> sizes, std::span<const double> times);

}  // namespace assay::reports
