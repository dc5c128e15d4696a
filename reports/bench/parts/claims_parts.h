// The parts of suite `claims` that stand in files of their own.
#pragma once

#include "corpus/cases/case_file.h"
#include "reports/bench/suites.h"

namespace assay::reports {

// Counts the box tests of bvh, of the vBVHs, and of vBVHs that skip nodes with one child; and
// times what looking at the children of a node costs beside a box test. REQUIRES cases of one
// step that starts clean.
void measure_search(const std::vector<corpus::Case>& steps, const BenchSettings& settings,
                    BenchReport& report);

// Measures marking over a sequence: its share of a step, and the nodes touched for each triangle
// that changed.
void measure_marking(const BenchSettings& settings, BenchReport& report);

// Checks that free steps touch no tree.
void count_traversals_of_free_steps(const BenchSettings& settings, BenchReport& report);

// Runs all scenes and real sequences step by step: the scatter of time over that of bvh and of
// normal-cone against the share of V+, the break-even shares, and view-auto's ratios by sequence.
void measure_break_even(const BenchSettings& settings, const BenchProgress& progress,
                        BenchReport& report);

}  // namespace assay::reports
