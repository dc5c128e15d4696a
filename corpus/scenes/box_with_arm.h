// A box with a square hole in its lid and an arm that grows out of a side wall, over the lid, and
// reaches through the hole: one connected, unclosed surface (its only boundary is the hole's rim).
#pragma once

#include "corpus/mesh_reader.h"

namespace assay::corpus {

// The box is [-1,1]^3, the hole |x|, |y| < 1/3 at z = 1; the arm is 0.2 wide. 200 b^2 + 4 b
// triangles for a resolution b >= 1.
struct BoxWithArm {
  explicit BoxWithArm(int size);

  Mesh mesh;  // with the arm at `tip_outside`

  // Positions with the tip of the arm at height z over the hole's middle. The arm touches nothing
  // for deepest_tip <= z <= tip_outside.
  detector::Positions with_tip(double z) const;

  static constexpr double tip_outside = 1.25;
  static constexpr double deepest_tip = -0.5;

 private:
  int resolution_;
  std::int32_t first_sliding_ = 0;  // vertices from here on are the rings that follow the tip
};

}  // namespace assay::corpus
