// A case through every variant of the detector, timed in turn and judged by the oracle.
#pragma once

#include <functional>

#include "reports/bench/judged_step.h"
#include "reports/bench/speed_error/error_families.h"

namespace assay::reports {

// Each variant carries its own state from step to step, as a user's would; every step is evaluated
// rounds + 1 times by all of them in turn (interleave.h) before it is committed. Culling none takes
// part up to 64 triangles: every pair of a large mesh would take the suite's whole time.
//
// Lines for `wrong`: exact arithmetic differs from the oracle in anything, bounded misses or is
// late, two evaluations of one step differ. `tick` is called between evaluations.
std::vector<JudgedStep> run_case(const ErrorFamily& family, const TimedCase& timed,
                                 std::vector<std::string>& wrong,
                                 const std::function<void()>& tick);

}  // namespace assay::reports
