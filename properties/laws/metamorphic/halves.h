// A step in two halves, against the whole.
#pragma once

#include "properties/laws/law.h"

namespace assay::properties {

// Every committed step of the case, rounded to a grid; the middle places of vertices, primitives
// and apexes are then exact. A pair of the whole is one of a half, at twice its time or at twice
// its time less one; a pair of a half is one of the whole.
void check_halves(CaseFacts& facts, LawTally& tally);

}  // namespace assay::properties
