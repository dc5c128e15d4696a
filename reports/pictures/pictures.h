// The picture of each suite that has one, as a script for gnuplot.
#pragma once

#include <string>

#include "reports/bench/bench_report.h"

namespace assay::reports {

// Speed against error, for detectors that are asked for all pairs. Across: the time of a step over
// that of the built-in detector, exact with culling bvh. Up: the share of unsafe steps (a contact
// is missed) and of alarming steps (one is reported that is none). Both have intervals, and each
// kind of error its Pareto line.
std::string speed_error_picture(const BenchReport& report);

// The same for the peers and the built-in detector beside them, each in its own contract.
std::string peers_picture(const BenchReport& report);

// The time of a step with views over that of bvh, and over that of normal-cone, against the share
// of triangles that are seen positive (V+).
std::string share_picture(const BenchReport& report);

// Times against triangles, both logarithmic, beside n log n.
std::string growth_picture(const BenchReport& report);

// Stability, as a heat map: for each hard family in each arithmetic, the share of cases that are
// answered right, over all strengths of the family.
std::string heat_picture(const BenchReport& report);

}  // namespace assay::reports
