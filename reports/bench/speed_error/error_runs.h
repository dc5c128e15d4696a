// Runs a case through every variant of the detector, timed in turn and judged by the oracle.
#pragma once

#include <functional>

#include "reports/bench/judged_step.h"
#include "reports/bench/speed_error/error_families.h"

namespace assay::reports {

// Each variant carries its own state from step to step, as it would for a user. All of them
// evaluate every step rounds + 1 times in turn (interleave.h) before it is committed. Culling none
// takes part up to 64 triangles, because every pair of a large mesh would take the suite's whole
// time.
//
// Adds a line to `wrong` if exact arithmetic differs from the oracle in anything, if bounded
// arithmetic misses or is late, or if two evaluations of one step differ. `tick` is called between
// evaluations.
std::vector<JudgedStep> run_case(const ErrorFamily& family, const TimedCase& timed,
                                 std::vector<std::string>& wrong,
                                 const std::function<void()>& tick);

}  // namespace assay::reports
