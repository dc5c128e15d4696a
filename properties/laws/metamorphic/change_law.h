// Metamorphic laws: a run that is changed in a way that must not matter gives the same results,
// changed likewise.
#pragma once

#include "properties/laws/metamorphic/pinned_run.h"
#include "properties/laws/step_law.h"

namespace assay::properties {

struct Change {
  PinnedRun run;
  std::vector<std::int32_t> triangle;  // by triangle: its index in the changed run
  bool swaps_signs = false;            // V+ becomes V-; what rests on L5 is then not compared
};

// Makes the change; nothing if it does not apply. The case's id is the only source of randomness.
using MakeChange = std::optional<Change> (*)(const CaseFacts&, const PinnedRun&);

// Compares the changed run with the given results. On a grid both sides are run anew, from
// coordinates that are rounded so that sums and halves are exact (grid.h).
void check_change(CaseFacts& facts, LawTally& tally, MakeChange make);
void check_change_on_a_grid(CaseFacts& facts, LawTally& tally, MakeChange make);

template <MakeChange make>
void check_change(CaseFacts& facts, LawTally& tally) {
  check_change(facts, tally, make);
}
template <MakeChange make>
void check_change_on_a_grid(CaseFacts& facts, LawTally& tally) {
  check_change_on_a_grid(facts, tally, make);
}

// L11: vertices and triangles in reverse order. Applies if there are two holes or more.
std::optional<Change> holes_in_another_order(const CaseFacts& facts, const PinnedRun& run);

}  // namespace assay::properties
