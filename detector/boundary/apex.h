// Where the apex of a ghost fan stands: a deterministic function of one frame's positions.
//
// During a step the apex moves linearly between its places at the two frames, so it is also
// continuous from step to step. An apex that stays behind, or jumps, misses contacts (cases D7,
// D9).
#pragma once

#include <array>

#include "detector/mesh/loops.h"

namespace assay::detector {

// Puts the apex at the loop's centroid, moved along the loop's mean normal by `height` times the
// diagonal of the loop's box. The centroid itself (height 0) would ruin culling on sheets, because
// ghosts through it cut the sheet.
struct ApexRule {
  double height = 0;
};

// The rules to choose from. Of several that are equally good the first is taken.
inline constexpr std::array<ApexRule, 5> apex_rules = {{{0.0}, {0.25}, {-0.25}, {1.0}, {-1.0}}};

// The place of the apex in one frame. It is computed in doubles, summed in the order of the loop,
// so it has the same bytes on every machine. If the mean normal vanishes or overflows it is the
// centroid. It is finite for finite positions.
Point place_apex(const ApexRule& rule, const Loop& loop, const PositionsView& x);

// The rows of x and, below them, the apexes at t=0 or, with at_end, at t=1.
Positions with_apexes(const PositionsView& x, const std::vector<MovingPoint>& apexes, bool at_end);

}  // namespace assay::detector
