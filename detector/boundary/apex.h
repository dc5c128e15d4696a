// Where the apex of a ghost fan stands: a deterministic function of one frame's positions.
//
// The apex of a step moves linearly between its places at the two frames, so it is continuous from
// step to step (cases D7, D9: an apex that stays behind, or jumps, misses contacts).
#pragma once

#include <array>

#include "detector/mesh/loops.h"

namespace assay::detector {

// The loop's centroid, moved along the loop's mean normal by `height` times the diagonal of the
// loop's box. The centroid alone ruins culling on sheets, which it cuts.
struct ApexRule {
  double height = 0;
};

// In the order in which ties are broken.
inline constexpr std::array<ApexRule, 5> apex_rules = {{{0.0}, {0.25}, {-0.25}, {1.0}, {-1.0}}};

// In doubles, summed in the order of the loop: the same bytes on every machine. The centroid where
// the mean normal vanishes or overflows. Finite for finite positions.
Point place_apex(const ApexRule& rule, const Loop& loop, const PositionsView& x);

// x, and below it the apexes' places at t=0 or t=1.
Positions with_apexes(const PositionsView& x, const std::vector<MovingPoint>& apexes, bool at_end);

}  // namespace assay::detector
