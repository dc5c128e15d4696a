// Integer-only random numbers, because the standard distributions differ between libraries;
// and the numbers of things in lists and grids.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::properties {

// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index) : state_(seed ^ (index * 0xd1342543de82ef95u)) {
    next();
    next();
  }
  // The random numbers of a name, such as a case's id, hashed by FNV-1a, 64 bits.
  explicit Random(std::string_view id) : Random(hash(id), 0) {}
  static constexpr std::uint64_t hash(std::string_view text) {
    std::uint64_t h = 0xcbf29ce484222325u;
    for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return h;
  }
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  // 0 .. n-1; n is small, so the bias of the remainder is below 2^-50.
  int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
  int between(int lo, int hi) { return lo + below(hi - lo + 1); }
  bool one_in(int n) { return below(n) == 0; }
  // Multiples of 2^-30 in [0, 1) and in [-1, 1): exact, so sums of a few stay exact.
  double unit() { return static_cast<double>(next() >> 34) * 0x1p-30; }
  double signed_unit() { return 2 * unit() - 1; }
  // A multiple of 2^-52 in [-1, 1).
  double full_mantissa() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1; }

 private:
  std::uint64_t state_;
};

// One item of a list that is not empty.
template <class List>
auto& one_of(Random& random, List& list) {
  return list[static_cast<std::size_t>(random.below(static_cast<int>(std::size(list))))];
}

// By Fisher and Yates.
template <class List>
List shuffled(Random& random, List list) {
  for (std::size_t i = list.size(); i > 1; --i) {
    const auto other = static_cast<std::size_t>(random.below(static_cast<int>(i)));
    std::swap(list[i - 1], list[other]);
  }
  return list;
}

// Begins each triangle at one of its corners.
template <class Triangles>
void begin_anywhere(Random& random, Triangles&& triangles) {
  for (auto&& corners : triangles)
    std::rotate(corners.begin(), corners.begin() + random.below(3), corners.end());
}

// Lists of the numbers of vertices or triangles, and of the points of a grid that is mapped onto
// itself.

using Numbers = std::vector<std::int32_t>;

using detector::at;

// 0 .. count - 1.
inline Numbers in_order(std::size_t count) {
  Numbers numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// Grids of side^dimensions points, numbered along the first axis first, and the maps of a grid
// onto itself: axes exchanged and mirrored.

// base^exponent in whole numbers. REQUIRES exponent >= 0.
inline int power(int base, int exponent) {
  int result = 1;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

// One map of the grid onto itself, for a grid of any side. Element i of what it returns is the
// number of the point onto which point i is mapped.
using ImageOfGrid = std::function<std::vector<int>(int side)>;
// Calls `visit` for each permutation of the axes with each choice of mirrored axes, the identity
// first. `visit` may keep the map.
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
