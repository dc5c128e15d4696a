#include "reports/estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

namespace {

std::vector<double> ratios(std::span<const double> a, std::span<const double> b) {
  std::vector<double> out;
  for (std::size_t i = 0; i < a.size(); ++i) out.push_back(a[i] / b[i]);
  return out;
}

// Computes the median, and reorders its argument for that.
double median_in_place(std::vector<double>& values) {
  const std::size_t half = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

// Draws items with replacement 2,000 times, from generators that are seeded alike. `figure_of` gets
// the indices that were drawn. The result is the interval that holds the middle 95 % of its values.
template <class FigureOf>
Estimate over_draws(std::size_t items, const FigureOf& figure_of) {
  constexpr int draws = 2'000;
  constexpr double share_below = 0.025;  // of the draws lies below the interval, and as much above
  properties::Random random("percentile bootstrap");
  std::vector<std::size_t> drawn(items);
  std::vector<double> figures;
  for (int d = 0; d < draws; ++d) {
    for (auto& i : drawn) i = static_cast<std::size_t>(random.below(static_cast<int>(items)));
    figures.push_back(figure_of(drawn));
  }
  return {0, quantile(figures, share_below), quantile(figures, 1 - share_below), {}};
}

}  // namespace

Estimate ratio_of(std::span<const double> a, std::span<const double> b) {
  return median_of(ratios(a, b));
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

Estimate bootstrap_median(std::vector<double> samples) {
  std::vector<double> values = samples;
  auto out = over_draws(samples.size(), [&](const std::vector<std::size_t>& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) values[i] = samples[drawn[i]];
    return median_in_place(values);
  });
  values = samples;
  out.value = median_in_place(values);
  out.samples = std::move(samples);
  return out;
}

Estimate bootstrap_ratio(std::span<const double> a, std::span<const double> b) {
  return bootstrap_median(ratios(a, b));
}

}  // namespace assay::reports
