#include "properties/campaign/gates/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>

namespace assay::properties {

double upper_bound(std::uint64_t failures, std::uint64_t trials, double risk) {
  if (trials == 0 || failures >= trials) return 1;
  return boost::math::binomial_distribution<double>::find_upper_bound_on_p(
      static_cast<double>(trials), static_cast<double>(failures), risk);
}

double risk_of_each(std::uint64_t bounds) {
  constexpr double family_risk = 0.05;
  static_assert(family_risk + family_confidence == 1);
  return family_risk / static_cast<double>(std::max<std::uint64_t>(bounds, 1));
}

}  // namespace assay::properties
