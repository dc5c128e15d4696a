// The parts of suite `claims`.
#pragma once

#include "corpus/formats/mesh_reader.h"
#include "reports/bench/suites.h"

namespace assay::reports {

// A step that starts clean.
struct NamedStep {
  std::string name;
  corpus::Sequence step;  // two frames
};

// Box tests of bvh, of the vBVHs, and of the vBVHs that skip nodes with one child; what looking at
// the children of a node costs beside a box test.
void measure_search(const std::vector<NamedStep>& steps, const BenchSettings& settings,
                    BenchReport& report);

// The traditional scheme beside bvh and view-point: box tests, candidates, time.
void compare_with_traditional(const std::vector<NamedStep>& steps, const BenchSettings& settings,
                              BenchReport& report);

// What the thesis as printed misses and saves, together and deviation by deviation.
void measure_as_printed(const BenchSettings& settings, BenchReport& report);

// Marking over a sequence: its share of a step, nodes touched for each triangle that changed.
void measure_marking(const BenchSettings& settings, BenchReport& report);

// Free steps touch no tree.
void count_traversals_of_free_steps(const BenchSettings& settings, BenchReport& report);

// The whole step: view cullings over bvh, exact over double. What is wanted of rod-twist (wanted.h)
// is asked of the last of `steps`, which is rod-twist where that is there.
void time_whole_steps(const std::vector<NamedStep>& steps, bool has_rod_twist,
                      const BenchSettings& settings, BenchReport& report);

// thick-cloth and codim-ipc-kick: candidates and times of view-auto beside those of bvh.
void compare_on_unclosed_data(const BenchSettings& settings, BenchReport& report);

// All scenes and real sequences, step by step: the scatter of time over that of bvh and of
// normal-cone against the share of V+, the break-even shares, view-auto's ratios by sequence.
void measure_break_even(const BenchSettings& settings, Progress& progress, BenchReport& report);

}  // namespace assay::reports
