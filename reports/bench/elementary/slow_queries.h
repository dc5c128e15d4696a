// Times the slowest single queries, from the family that is kept for this: the elementary test and
// the view test in exact arithmetic (properties/queries/extreme_queries.h).
#pragma once

#include "reports/bench/suites.h"

namespace assay::reports {

// 250,000 vertex-face and edge-edge queries each with their times, and as many views from a point
// and from a line. Two minutes of processor time at scale 1.
void time_slow_queries(const BenchSettings& settings, BenchReport& report);

}  // namespace assay::reports
