// The parts of suite `claims`.
#pragma once

#include "corpus/formats/sequence_reader.h"
#include "reports/bench/suites.h"

namespace assay::reports {

// A step that starts clean.
struct NamedStep {
  std::string name;
  corpus::Sequence step;  // two frames
};

// Counts the box tests of bvh, of the vBVHs, and of vBVHs that skip nodes with one child; and
// times what looking at the children of a node costs beside a box test.
void measure_search(const std::vector<NamedStep>& steps, const BenchSettings& settings,
                    BenchReport& report);

// Compares the traditional scheme with bvh and view-point: box tests, candidates, time.
void compare_with_traditional(const std::vector<NamedStep>& steps, const BenchSettings& settings,
                              BenchReport& report);

// Measures what the thesis as printed misses and saves, as a whole and deviation by deviation.
void measure_as_printed(const BenchSettings& settings, BenchReport& report);

// Measures marking over a sequence: its share of a step, and the nodes touched for each triangle
// that changed.
void measure_marking(const BenchSettings& settings, BenchReport& report);

// Checks that free steps touch no tree.
void count_traversals_of_free_steps(const BenchSettings& settings, BenchReport& report);

// Times the whole step: view cullings over bvh, and exact over double. What is wanted of rod-twist
// (wanted.h) is asked of the last of `steps`, which is rod-twist if `has_rod_twist`.
void time_whole_steps(const std::vector<NamedStep>& steps, bool has_rod_twist,
                      const BenchSettings& settings, BenchReport& report);

// Compares view-auto with bvh on thick-cloth and codim-ipc-kick: candidates and times.
void compare_on_unclosed_data(const BenchSettings& settings, BenchReport& report);

// Runs all scenes and real sequences step by step: the scatter of time over that of bvh and of
// normal-cone against the share of V+, the break-even shares, and view-auto's ratios by sequence.
void measure_break_even(const BenchSettings& settings, Progress& progress, BenchReport& report);

}  // namespace assay::reports
