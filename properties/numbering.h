// Makes lists of vertex or triangle numbers, turns lists of triples into matrices, and maps a grid
// of numbered points onto itself.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <vector>

#include "properties/words.h"

namespace assay::properties {

using Numbers = std::vector<std::int32_t>;

using detector::at;

// Returns a list of triples, such as corners or points, as the rows of a matrix.
template <class Matrix, class Triples>
Matrix as_rows(const Triples& triples) {
  const auto* first = std::empty(triples) ? nullptr : std::begin(triples)->data();
  return Eigen::Map<const Matrix>(first, static_cast<Eigen::Index>(std::size(triples)), 3);
}

// Returns the list 0 .. count - 1.
inline Numbers in_order(std::size_t count) {
  Numbers numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// A grid has side^dimensions points. Their numbers grow along the first axis first. A symmetry
// maps a grid onto itself: it exchanges and mirrors axes.

// Returns base^exponent in whole numbers. REQUIRES exponent >= 0.
inline int power(int base, int exponent) {
  int result = 1;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

// A symmetry of grids of any side. Element i of its result is the number of the point onto which
// the symmetry maps point i.
using ImageOfGrid = std::function<std::vector<int>(int side)>;
// Calls `visit` for each permutation of the axes with each choice of mirrored axes, the identity
// first. A symmetry is valid only until `visit` returns.
inline void for_each_symmetry(int dimensions,
                              const std::function<void(const ImageOfGrid&)>& visit) {
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
