// Metamorphic laws: a run that is changed in a way that must not matter gives the same results,
// changed likewise.
#pragma once

#include "properties/laws/metamorphic/pinned_run.h"
#include "properties/laws/step_law.h"

namespace assay::properties {

// Runs are rounded to coordinates of few bits, so that translations and midpoints are exact.

// The run with every coordinate of vertices, primitives and apexes rounded to a multiple of one
// power of two: 2^-30 of the least power of two above them all (or the least denormal, if that is
// greater).
PinnedRun on_a_grid(PinnedRun run);

// The exponent of the least power of two above all coordinates.
int exponent_above(const PinnedRun& run);

// Applies `move` to every vertex, primitive and apex of every frame.
void move_points(PinnedRun& run, const std::function<detector::Point(detector::Point)>& move);

struct Change {
  PinnedRun run;
  std::vector<std::int32_t> triangle;  // by triangle: its index in the changed run
  bool swaps_signs = false;            // V+ becomes V-; what rests on L5 is then not compared
};

// Makes the change; nothing if it does not apply. The case's id is the only source of randomness.
using MakeChange = std::optional<Change> (*)(std::string_view, const PinnedRun&);

// Compares the changed run with the given results. On a grid both sides are run anew, from
// coordinates that are rounded so that sums and halves are exact (round_to_grid).
void check_change(CaseFacts& facts, LawTally& tally, MakeChange make, bool on_grid);
template <MakeChange make, bool on_grid = false>
void check_change(CaseFacts& facts, LawTally& tally) {
  check_change(facts, tally, make, on_grid);
}

// L11: vertices and triangles in reverse order. Applies if there are two holes or more.
std::optional<Change> holes_in_another_order(std::string_view id, const PinnedRun& run);

}  // namespace assay::properties
