#include "properties/campaign/trials/planned_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "properties/judging/contracted_case.h"

namespace assay::properties {
namespace {

double largest_of(const corpus::Case& c) {
  double largest = 0;
  for (const auto& frame : c.frames) {
    if (frame.size() > 0) largest = std::max(largest, frame.cwiseAbs().maxCoeff());
  }
  return largest;
}

// Multiplies by 2^exponent. The result is 0 if the scaling would round it, or if the contract does
// not take it because it is below `least`.
double scaled(double x, int exponent, double least) {
  const double y = std::ldexp(x, exponent);
  const bool is_exact = std::ldexp(y, -exponent) == x;
  return is_exact && std::abs(y) >= least ? y : 0;
}

template <class Places>
void scale_all(Places& places, int exponent, double least) {
  for (auto& place : places) {
    for (double& x : place) x = scaled(x, exponent, least);
  }
}

}  // namespace

corpus::Case brought_into_range(corpus::Case c, const Contract& contract) {
  if (!contract.has_range()) return c;
  const double largest = largest_of(c);
  int exponent = 0;
  if (largest > contract.largest) {
    exponent = std::ilogb(contract.largest) - std::ilogb(largest);
    if (std::ldexp(largest, exponent) > contract.largest) --exponent;
  }
  const double least = contract.least_nonzero;
  for (auto& frame : c.frames)
    frame = frame.unaryExpr([&](double x) { return scaled(x, exponent, least); }).eval();
  if (c.view) {
    scale_all(c.view->q0, exponent, 0);
    scale_all(c.view->q1, exponent, 0);
  }
  if (c.ghosts) {
    for (auto& apexes : c.ghosts->apexes) scale_all(apexes, exponent, 0);
  }
  return c;
}

PlannedCase case_within(const Contract& contract, const Family& family, const std::string& id) {
  PlannedCase planned;
  for (; planned.redrawn <= most_redrawn; ++planned.redrawn) {
    const auto attempt = planned.redrawn == 0 ? id : fmt::format("{}~{}", id, planned.redrawn);
    planned.made = make_case(family, attempt);
    planned.made.c = brought_into_range(std::move(planned.made.c), contract);
    planned.seen = contracted(planned.made.c, contract);
    if (!planned.seen) continue;
    planned.steps_left_out =
        corpus::steps_of(planned.made.c).size() - corpus::steps_of(*planned.seen).size();
    break;
  }
  return planned;
}

}  // namespace assay::properties
