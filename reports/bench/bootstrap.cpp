#include "reports/bench/bootstrap.h"

#include <algorithm>

#include "properties/random.h"

namespace assay::reports {
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
