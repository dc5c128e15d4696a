// A box with a square hole in its lid and an arm that grows out of a side wall, over the lid, and
// reaches through the hole: one connected, unclosed surface (its only boundary is the hole's rim).
#pragma once

#include "corpus/formats/mesh_reader.h"

namespace assay::corpus {

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
