// Compares a step in two halves with the whole step.
#pragma once

#include <optional>

#include "properties/laws/law.h"
#include "properties/laws/metamorphic/pinned_run.h"

namespace assay::properties {

// Checks every committed step of the case, rounded to a grid, so that the middle places of
// vertices, primitives and apexes are exact. A pair of the whole step is one of a half, at twice
// its time or at twice its time less one; and a pair of a half is one of the whole.
void check_halves(CaseFacts& facts, LawTally& tally);

// The run with every committed step in two halves; nothing if some middle place is no double.
std::optional<PinnedRun> halved_run(const PinnedRun& whole);

}  // namespace assay::properties
