// From which share of V+ on a step with views costs no more than one with culling bvh.
#pragma once

#include <optional>
#include <span>

#include "reports/bench/bench_report.h"

namespace assay::reports {

struct BreakEven {
  // The share at which the line fitted to log(ratio) over the share crosses 1. It is fitted to the
  // steps that search; those with a share of 1 touch no tree and are left out. Nothing if it does
  // not cross within [0, 1].
  std::optional<double> by_fit;
  // The last crossing: the largest share of a point with a ratio above 1, so that every step with
  // a larger share was faster than bvh. 0 if all were.
  double last_crossing = 0;
};

BreakEven break_even(std::span<const ScatterPoint> points);

}  // namespace assay::reports
