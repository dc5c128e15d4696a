// The picture of each suite that has one, as a script for gnuplot.
#pragma once

#include <string>

#include "reports/bench/bench_report.h"

namespace assay::reports {

// Speed against error: the time over that of exact, bvh, against the share of unsafe and of
// alarming steps, with intervals on both axes and the Pareto line of each error. All pairs.
std::string speed_error_picture(const BenchReport& report);

// The same for the peers and the built-in detector beside them, each in its own contract.
std::string peers_picture(const BenchReport& report);

// Time of a step over that of bvh, and of normal-cone, against the share of V+.
std::string share_picture(const BenchReport& report);

// Times against triangles, both logarithmic, beside n log n.
std::string growth_picture(const BenchReport& report);

// Stability: the share of cases that are right, over all strengths, for each hard family in each
// arithmetic.
std::string heat_picture(const BenchReport& report);

}  // namespace assay::reports
