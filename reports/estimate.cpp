#include "reports/estimate.h"

#include <algorithm>
#include <cmath>

#include "properties/random.h"

namespace assay::reports {

std::size_t rank_of_lower_end(std::size_t n) {
  constexpr double risk = 0.05;
  // term is P(B = k), and below is P(B < k).
  double term = std::pow(0.5, static_cast<double>(n)), below = 0;
  std::size_t k = 0;
  while (k < n / 2 && 2 * (below + term) <= risk) {
    below += term;
    term *= static_cast<double>(n - k) / static_cast<double>(k + 1);
    ++k;
  }
  return std::max<std::size_t>(k, 1);
}

Estimate median_of(std::vector<double> samples) {
  std::vector<double> sorted = samples;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size(), k = rank_of_lower_end(n);
  return {(sorted[(n - 1) / 2] + sorted[n / 2]) / 2, sorted[k - 1], sorted[n - k],
          std::move(samples)};
}

Estimate exactly(double value) { return {value, value, value, {value}}; }

Estimate ratio_of(std::span<const double> a, std::span<const double> b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return median_of(std::move(ratios));
}

Estimate scaled(Estimate estimate, double factor) {
  for (double* x : {&estimate.value, &estimate.lo, &estimate.hi}) *x *= factor;
  for (double& x : estimate.samples) x *= factor;
  return estimate;
}

double quantile(std::vector<double> samples, double share) {
  const auto n = static_cast<double>(samples.size());
  const auto rank = static_cast<std::size_t>(std::clamp(std::ceil(share * n), 1.0, n));
  const auto at = samples.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(samples.begin(), at, samples.end());
  return *at;
}

Line fit_line(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double slope = xy / xx;
  return {mean_y - slope * mean_x, slope};
}

double growth_exponent(std::span<const double> sizes, std::span<const double> times) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    x.push_back(std::log(sizes[i]));
    y.push_back(std::log(times[i]));
  }
  return fit_line(x, y).slope;
}

namespace {

// Computes the median, and reorders its argument for that.
double median_in_place(std::vector<double>& values) {
  const std::size_t half = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

constexpr int draws = 2'000;
// This share of the draws lies below the interval, and as much above it.
constexpr double share_below = 0.025;

properties::Random generator() { return properties::Random("percentile bootstrap"); }

}  // namespace

Estimate bootstrap_median(std::vector<double> samples) {
  properties::Random random = generator();
  std::vector<double> drawn(samples.size()), medians;
  const int n = static_cast<int>(samples.size());
  for (int d = 0; d < draws; ++d) {
    for (double& x : drawn) x = samples[static_cast<std::size_t>(random.below(n))];
    medians.push_back(median_in_place(drawn));
  }
  drawn = samples;
  const double lo = quantile(medians, share_below), hi = quantile(medians, 1 - share_below);
  return {median_in_place(drawn), lo, hi, std::move(samples)};
}

Estimate bootstrap_ratio(std::span<const double> a, std::span<const double> b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return bootstrap_median(std::move(ratios));
}

Estimate bootstrap_ratio_of_sums(std::span<const double> a, std::span<const double> b) {
  properties::Random random = generator();
  const int n = static_cast<int>(a.size());
  std::vector<double> drawn, samples;
  double all_a = 0, all_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    samples.push_back(a[i] / b[i]);
    all_a += a[i];
    all_b += b[i];
  }
  for (int d = 0; d < draws; ++d) {
    double sum_a = 0, sum_b = 0;
    for (int k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(random.below(n));
      sum_a += a[i];
      sum_b += b[i];
    }
    drawn.push_back(sum_a / sum_b);
  }
  return {all_a / all_b, quantile(drawn, share_below), quantile(drawn, 1 - share_below),
          std::move(samples)};
}

}  // namespace assay::reports
