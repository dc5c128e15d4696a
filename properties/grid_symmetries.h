// Grids of side^dimensions points, numbered along the first axis first, and the maps of a grid
// onto itself: axes exchanged and mirrored.
#pragma once

#include <functional>
#include <vector>

namespace assay::properties {

// base^exponent in whole numbers. REQUIRES exponent >= 0.
int power(int base, int exponent);

// `image_of(side)` gives the image of each point, by point, on the grid of that side. It is the
// same map for all sides.
using ImageOfGrid = std::function<std::vector<int>(int side)>;
// Calls `visit` for each exchange of axes with each choice of mirrored axes, the identity first.
void for_each_symmetry(int dimensions, const std::function<void(const ImageOfGrid&)>& visit);

}  // namespace assay::properties
