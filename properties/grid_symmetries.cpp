#include "properties/grid_symmetries.h"

#include <algorithm>
#include <array>

namespace assay::properties {

int power(int base, int exponent) {
  int result = 1;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

void for_each_symmetry(int dimensions, const std::function<void(const ImageOfGrid&)>& visit) {
  std::array<int, 3> axes = {0, 1, 2};
  int mirrored = 0;
  const ImageOfGrid image_of = [&](int side) {
    std::vector<int> image;
    for (int p = 0; p < power(side, dimensions); ++p) {
      int to = 0;
      for (int k = 0; k < dimensions; ++k) {
        const int c = p / power(side, axes[static_cast<std::size_t>(k)]) % side;
        to += ((mirrored >> k) % 2 == 0 ? c : side - 1 - c) * power(side, k);
      }
      image.push_back(to);
    }
    return image;
  };
  do {
    for (mirrored = 0; mirrored < power(2, dimensions); ++mirrored) visit(image_of);
  } while (std::next_permutation(axes.begin(), axes.begin() + dimensions));
}

}  // namespace assay::properties
