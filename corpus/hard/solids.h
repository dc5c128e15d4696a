// The two solids of most hard cases: a block with a face in the plane z = 0, and a spike above it.
//
// Why their answers are plain: the block lies in z <= 0 and the spike above its tip (or its lower
// edge), so nothing meets before the tip or edge reaches z = 0. In a case that is to miss beside
// the block, a plane of constant x or y lies between the two all the time.
#pragma once

#include "corpus/hard/grid_mesh.h"

namespace assay::corpus {

// 2^exponent units.
inline std::int64_t two_to(int exponent) { return std::int64_t{1} << exponent; }

// The usual size of a solid. With growth (37) and heights up to twice that size, coordinates are
// below 2^52.
inline constexpr int usual_exponent = 45;
inline constexpr std::int64_t usual_size = std::int64_t{1} << usual_exponent;

// A triangle in z = 0 whose inside holds all points within reach / 8 of the origin. Its corners
// are at most `reach` away along each axis. REQUIRES reach >= 32.
std::array<GridPoint, 3> wide_face(Variation& vary, std::int64_t reach);

// Adds the block under a wide face; its fourth corner is `depth` deep, near the axis.
void add_block(GridMesh& mesh, Variation& vary, std::int64_t reach, std::int64_t depth);

// To which side of its tip a spike may reach.
enum class Side { all_around, positive_y, negative_y };

// Adds a tetrahedron that moves along with its tip. The other corners are up to `reach` away along
// x and y, to this side only, and `height` to 3 `height` above the tip.
void add_spike(GridMesh& mesh, Variation& vary, const GridVertex& tip, std::int64_t reach,
               std::int64_t height, Side side);

// A place at height z, straight over or under the inside of every wide face of this reach.
GridPoint under_the_face(Variation& vary, std::int64_t reach, std::int64_t z);

// A vertex at (p.x, p.y) that goes from height z_t0 to z_t1.
GridVertex falling(const GridPoint& p, std::int64_t z_t0, std::int64_t z_t1);

KnownFacts known_free();
// A collision at this first time, which is a double; without it, the first time is not stated.
KnownFacts known_collision(double first);
KnownFacts known_collision();

}  // namespace assay::corpus
