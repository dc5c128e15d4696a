// Fields that move each vertex by itself. All of them are the identity at s = 0.
//
// s in [0,1] is the scene's own time. `Extent` scales a field to the mesh that it is applied to.
#pragma once

#include "corpus/formats/mesh_reader.h"

namespace assay::corpus {

struct Extent {
  detector::Point centre = {0, 0, 0};
  double radius = 1;     // half the longest side of the box around the mesh
  std::size_t axis = 2;  // of that side
};

// Middle, half-length and axis of the box around a mesh; a mesh without extent gets radius 1.
Extent extent_of(const detector::PositionsView& positions);

using Field = detector::Point (*)(const detector::Point& x, double s, const Extent& extent);

// Moves each vertex along its ray from the centre, by about 25 % and unevenly: out, back, and
// inward. A mesh that is positive from the centre stays so, between the frames too.
detector::Point breathe(const detector::Point& x, double s, const Extent& extent);

// Bends the long axis into an arc, at the end of 1.02 turns of a circle, so that a tube's ends
// meet.
detector::Point bend(const detector::Point& x, double s, const Extent& extent);

// Turns each place about the long axis in proportion to its height, one turn from end to end.
detector::Point twist(const detector::Point& x, double s, const Extent& extent);

// Shrinks and adds waves that fold the surface over itself.
detector::Point crumple(const detector::Point& x, double s, const Extent& extent);

// The fields below are for shapes of this room, in their own coordinates; they do not use
// `extent`.
// Pushes the cap around +z down through the sphere and out at the other side.
detector::Point dent(const detector::Point& x, double s, const Extent& extent);
// Presses the torus's hole shut at x = 0.
detector::Point pinch(const detector::Point& x, double s, const Extent& extent);
// Rolls the sheet up about a line x = 0.15 until its free edge comes down on it.
detector::Point fold(const detector::Point& x, double s, const Extent& extent);
// Narrows the tube to a waist around z = 0, at the end 40 % as wide.
detector::Point narrow(const detector::Point& x, double s, const Extent& extent);

}  // namespace assay::corpus
