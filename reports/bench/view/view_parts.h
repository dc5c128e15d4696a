// The parts of suite `view`.
#pragma once

#include "reports/bench/suites.h"

namespace assay::reports {

// Times the view test over the writing of swept boxes from the same arrays, for each instruction
// set that this machine has. Signs that differ between the sets are wrong answers.
void time_view_test(const BenchSettings& settings, BenchReport& report);

// Times steps that are all positive: over culling bvh on the same step, and by themselves.
void time_free_steps(const BenchSettings& settings, BenchReport& report);

// Measures V0 beyond the exact V0, and the shares of V+ and V-. A sign that is not the oracle's is
// a wrong answer.
void measure_tightness(const BenchSettings& settings, BenchReport& report);

}  // namespace assay::reports
