// Suite `stability` over any families and subjects, so that tests can hand in wrong ones.
#pragma once

#include <span>

#include "corpus/hard/hard_families.h"
#include "reports/bench/stability/stability_run.h"
#include "reports/bench/suites.h"

namespace assay::reports {

// The rows are family by family and subject by subject. These are wrong answers: an exact subject
// that is wrong, a bounded one that misses or is late, and an oracle that contradicts a
// construction.
BenchReport stability_of(std::span<const corpus::HardFamily> families,
                         std::span<const StabilitySubject> subjects, const BenchSettings& settings,
                         Progress& progress);

}  // namespace assay::reports
