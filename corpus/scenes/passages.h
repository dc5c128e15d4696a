// Unclosed surfaces that go through their own holes, or around them, and back again.
//
// Fields as in deformations.h, for shapes of this room in their own coordinates, but periodic: the
// places at s = 1 are those at s = 0, bit by bit, so that a sequence can be played again and again.
// Those of a tube take tube_shape (radius 0.5, z from -3 to 3). Free of contact where a step is at
// most a fortieth of the period.
#pragma once

#include "corpus/scenes/deformations.h"

namespace assay::corpus {

// The tube's upper end is rolled outward and down over the tube until all of it is inside out. The
// identity at s = 0.
detector::Point turn_inside_out(const detector::Point& x, double s, const Extent& extent);

// The tube, tapered to the upper end and cut obliquely there, is an arc of 0.85 turns; at s = 1/2
// it is one of 1.1, with the narrow end inside of the wide one. While it goes in, the fans over the
// two ends cross.
detector::Point bite_tail(const detector::Point& x, double s, const Extent& extent);

// ribbon_shape as a spiral of 1.25 turns, at s = 1/2 of 2.75, its own fan right across it.
detector::Point wind(const detector::Point& x, double s, const Extent& extent);

// The way of a ball along the tube's axis: from 4.5 below its middle to 4.5 above.
double ball_height(double s);

}  // namespace assay::corpus
