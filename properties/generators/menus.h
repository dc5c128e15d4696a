// Coordinate menus: the kinds of doubles that a case is made of. Each function changes all frames
// and the view primitive alike.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Rounds to multiples of 2^-bits (small integers for bits = 0) after scaling by `scale`.
void round_to_grid(Draft& draft, double scale, int bits);

// Gives some vertices a coordinate that lies beside another vertex's, by 1 to 3 units of the last
// place.
void place_ulp_neighbours(Random& random, Draft& draft);

// Adds an offset with exponents up to 40, so that low bits are rounded away.
void move_far(Random& random, Draft& draft);

// Scales by powers of two: one for all, or one for each axis, or one for each vertex (from the
// origin, so that what is positive from there stays so). They lie within 2^+-60; one in 16 up to
// 2^+-400.
void mix_scales(Random& random, Draft& draft);

// Makes all coordinates integers times 2^-1074, or replaces a few coordinates by such numbers.
void make_denormal(Random& random, Draft& draft);

// Makes meshes that are nearly degenerate, by one or two of these: neighbouring doubles; a vertex
// within 2^-20 to 2^-45 of another vertex, or of an edge or a face that does not hold it, in one
// frame or in all. Tagged "menu:...".
void miss_nearly(Random& random, Draft& draft);

}  // namespace assay::properties
