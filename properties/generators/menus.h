// Coordinate menus: what kinds of doubles a case is made of. Each changes all frames and the view
// primitive alike.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

// Multiples of 2^-bits: small integers for bits = 0, after scaling by `scale`.
void round_to_grid(Draft& draft, double scale, int bits);

// Some vertices get a coordinate that is beside another vertex's: 1 to 3 units of the last place.
void place_ulp_neighbours(Random& random, Draft& draft);

// Adds an offset with exponents up to 40: low bits are rounded away.
void move_far(Random& random, Draft& draft);

// One power of two for all, or one for each axis, or one for each vertex (from the origin, so that
// what is positive from there stays so). Within 2^+-60; one in 16 up to 2^+-400.
void mix_scales(Random& random, Draft& draft);

// All as integers times 2^-1074, or a few coordinates replaced by such.
void make_denormal(Random& random, Draft& draft);

}  // namespace assay::properties
