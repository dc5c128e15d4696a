// Scenes that are a mesh for every s in [0,1], the scene's own time, or for every place of a tip.
//
// The first are of the kinds that fill a collision detector with work: many layers, many bodies, a
// body wound about itself, many thin strips. At s = 0 nothing touches. How far anything moves, and
// how thick and close it is, does not depend on `size`, which is the wanted number of triangles;
// where a shape has a number of parts, a larger size has more of them.
#pragma once

#include "corpus/formats/mesh_reader.h"

namespace assay::corpus {

// Square sheets one over the other, in the same folds, and nearer than they are moved: each slides
// and bulges in its own way. 50 of them from 1,600 triangles on, else fewer.
Mesh layered_cloth(int size, double s);

// Spheres of 80 triangles and several radii on a cubic grid, which draws together while they turn.
// 1,000 of them at 80,000 triangles.
Mesh pile_of_bodies(int size, double s);

// A closed tube along a trefoil knot. The knot is drawn together while the tube stays as thick as
// it is. It is twelve times as many pieces long as around.
Mesh tightening_knot(int size, double s);

// Strips of 48 triangles that hang down side by side, all bent alike, and are combed: the columns
// lean to one side and to the other in turn. 5,000 of them at 240,000 triangles.
Mesh combed_hair(int size, double s);

// A box with a square hole in its lid and an arm that grows out of a side wall, over the lid, and
// reaches through the hole: one connected, unclosed surface (its only boundary is the hole's rim).
//
// The box is [-1,1]^3, the hole |x|, |y| < 1/3 at z = 1; the arm is 0.2 wide. Edges are of about
// one length all over, 2 / (3 b) for a resolution b >= 1, and the arm has k = max(1, b / 3) of
// them on each of its four sides. There are 106 b^2 + 80 b k - 2 k^2 + 12 k triangles. When the
// arm is deepest at most 16 b k + 12 k of them are inside: below 5 % if b is 3 or more (1,204
// triangles).
struct BoxWithArm {
  explicit BoxWithArm(int size);

  Mesh mesh;  // with the arm at `tip_outside`

  // The positions when the tip of the arm is at height z over the hole's middle. The arm touches
  // nothing for deepest_tip <= z <= tip_outside.
  detector::Positions with_tip(double z) const;

  static constexpr double tip_outside = 1.25;
  static constexpr double deepest_tip = -0.45;

 private:
  int resolution_;
  std::int32_t first_sliding_ = 0;  // vertices from here on are the rings that follow the tip
};

}  // namespace assay::corpus
