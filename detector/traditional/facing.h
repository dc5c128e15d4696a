// Which of a fixed set of directions a triangle faces over a whole step: N(t).d > 0 at every t.
//
// A normal cone of [VMT94] serves one purpose: to show that there is a direction d with N.d > 0
// for all triangles of a patch. Instead of a cone, this file keeps the set of such directions d
// themselves, out of 50 fixed ones. Two patches are merged by the intersection of their sets. That
// is exact, it needs no normalizations as the thesis does, and a merged set is never looser than
// its triangles. A patch has a normal cone if its set is not empty.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "detector/bernstein/bernstein.h"

namespace assay::detector {

// Bit 2i stands for axis i, bit 2i+1 for its opposite.
using DirectionSet = std::uint64_t;

inline constexpr int facing_axes = 25;
inline constexpr int facing_directions = 2 * facing_axes;

// Coordinates are 0, 1, -1, 2 or -2: products with them are exact.
using Direction = std::array<double, 3>;
Direction direction(int bit);

// The directions that a triangle faces at every t of the step. A direction of which doubles cannot
// tell this is left out. Empty for a triangle that has no area at some time. 0.1 us.
DirectionSet faced_directions(const std::array<MovingPoint, 3>& triangle);

// The bit of the direction in `set` that is nearest to `vector`. REQUIRES that `set` is not empty.
int nearest_direction(DirectionSet set, const Vector& vector);

}  // namespace assay::detector
