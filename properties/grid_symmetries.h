// Grids of side^dimensions points, numbered along the first axis first, and the maps of a grid
// onto itself: axes exchanged and mirrored.
#pragma once

#include <functional>
#include <vector>

namespace assay::properties {

// base^exponent in whole numbers. REQUIRES exponent >= 0.
int power(int base, int exponent);

// One map of the grid onto itself, for a grid of any side. Element i of what it returns is the
// number of the point onto which point i is mapped.
using ImageOfGrid = std::function<std::vector<int>(int side)>;
// Calls `visit` for each permutation of the axes with each choice of mirrored axes, the identity
// first. `visit` may keep the map.
void for_each_symmetry(int dimensions, const std::function<void(const ImageOfGrid&)>& visit);

}  // namespace assay::properties
