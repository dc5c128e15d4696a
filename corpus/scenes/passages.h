// Takes unclosed surfaces through their own holes, or around them, and back again.
//
// These are fields as in deformations.h, for shapes of this room in their own coordinates, but
// periodic: the places at s = 1 are those at s = 0, bit by bit, so that a sequence can be played
// again and again. Fields of a tube take tube_shape (radius 0.5, z from -3 to 3). There is no
// contact if a step is at most a fortieth of the period.
#pragma once

#include "corpus/scenes/deformations.h"

namespace assay::corpus {

// Rolls the tube's upper end outward and down over the tube until all of it is inside out. The
// identity at s = 0.
detector::Point turn_inside_out(const detector::Point& x, double s, const Extent& extent);

// Tapers the tube to the upper end, cuts it obliquely there, and bends it to an arc: of 0.85 turns
// at s = 0, and of 1.1 turns at s = 1/2, when the narrow end is inside of the wide one. While it
// goes in, the fans over the two ends cross.
detector::Point bite_tail(const detector::Point& x, double s, const Extent& extent);

// Winds ribbon_shape up to a spiral, of 1.25 turns at s = 0 and of 2.75 at s = 1/2. Its own fan
// lies right across it.
detector::Point wind(const detector::Point& x, double s, const Extent& extent);

// The height of a ball over the tube's middle: it goes along the axis from -4.5 to 4.5 and back.
double ball_height(double s);

}  // namespace assay::corpus
