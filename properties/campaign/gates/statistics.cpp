#include "properties/campaign/gates/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/special_functions/beta.hpp>

namespace assay::properties {

double upper_bound(std::uint64_t failures, std::uint64_t trials, double risk) {
  if (trials == 0 || failures >= trials) return 1;
  return boost::math::binomial_distribution<double>::find_upper_bound_on_p(
      static_cast<double>(trials), static_cast<double>(failures), risk);
}

ShareInterval share_interval(double of, double in, double independent) {
  ShareInterval interval;
  if (!(in > 0) || !(independent > 0)) return interval;
  const double n = std::min(independent, in), k = of / in * n;
  constexpr double each_side = 0.025;
  // The tails of a binomial distribution are beta distributions, so the ends of the interval are
  // quantiles of these.
  if (k > 0) interval.lo = boost::math::ibeta_inv(k, n - k + 1, each_side);
  if (k < n) interval.hi = boost::math::ibeta_inv(k + 1, n - k, 1 - each_side);
  return interval;
}

double risk_of_each(std::uint64_t bounds) {
  constexpr double family_risk = 0.05;
  static_assert(family_risk + family_confidence == 1);
  return family_risk / static_cast<double>(std::max<std::uint64_t>(bounds, 1));
}

}  // namespace assay::properties
