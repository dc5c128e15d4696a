// From which share of V+ on a step with views is no dearer than one with culling bvh.
#pragma once

#include <optional>
#include <span>

#include "reports/bench/bench_report.h"

namespace assay::reports {

struct BreakEven {
  // Where the line fitted to log(ratio) over the share crosses 1, by the steps that search: those
  // with a share of 1 touch no tree and are left out. None when it does not within [0, 1].
  std::optional<double> by_fit;
  // The last crossing: the largest share of a point with a ratio above 1; every step with a larger
  // share was faster than bvh. 0 when all were.
  double last_crossing = 0;
};

BreakEven break_even(std::span<const ScatterPoint> points);

}  // namespace assay::reports
