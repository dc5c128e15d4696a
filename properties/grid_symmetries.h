// Grids of side^dimensions points, numbered along the first axis first, and the maps of one onto
// itself: axes exchanged and mirrored.
#pragma once

#include <functional>
#include <vector>

namespace assay::properties {

// Whole numbers, exponent >= 0.
int power(int base, int exponent);

// `image_of(side)` gives, by point, its image on the grid of that side under one and the same map.
using ImageOfGrid = std::function<std::vector<int>(int side)>;
// Calls visit for each exchange of axes with each choice of mirrored ones, the identity first.
void for_each_symmetry(int dimensions, const std::function<void(const ImageOfGrid&)>& visit);

}  // namespace assay::properties
