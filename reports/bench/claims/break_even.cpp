#include "reports/bench/claims/break_even.h"

#include <algorithm>
#include <cmath>

namespace assay::reports {

BreakEven break_even(std::span<const ScatterPoint> points) {
  std::vector<double> shares, logs;
  BreakEven out;
  for (const auto& p : points) {
    if (p.ratio > 1) out.last_crossing = std::max(out.last_crossing, p.share);
    if (p.share >= 1) continue;
    shares.push_back(p.share);
    logs.push_back(std::log(p.ratio));
  }
  if (shares.size() < 2) return out;
  const Line line = fit_line(shares, logs);
  if (line.slope != 0) {
    const double share = -line.intercept / line.slope;
    if (share >= 0 && share <= 1) out.by_fit = share;
  }
  return out;
}

}  // namespace assay::reports
