#include "reports/bench/bootstrap.h"

#include <algorithm>

#include "properties/random.h"

namespace assay::reports {
namespace {

// Reorders its argument.
double median_in_place(std::vector<double>& values) {
  const std::size_t half = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

}  // namespace

Estimate bootstrap_median(std::vector<double> samples) {
  constexpr int draws = 2'000;
  constexpr double below = 0.025;
  properties::Random random("percentile bootstrap");
  std::vector<double> drawn(samples.size()), medians;
  const int n = static_cast<int>(samples.size());
  for (int d = 0; d < draws; ++d) {
    for (double& x : drawn) x = samples[static_cast<std::size_t>(random.below(n))];
    medians.push_back(median_in_place(drawn));
  }
  drawn = samples;
  const double lo = quantile(medians, below), hi = quantile(medians, 1 - below);
  return {median_in_place(drawn), lo, hi, std::move(samples)};
}

Estimate bootstrap_ratio(std::span<const double> a, std::span<const double> b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return bootstrap_median(std::move(ratios));
}

}  // namespace assay::reports
