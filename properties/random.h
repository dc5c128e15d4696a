// Draws random numbers with integer arithmetic only, because the distributions of the standard
// library differ between implementations.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>

namespace assay::properties {

// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index) : state_(seed ^ (index * 0xd1342543de82ef95u)) {
    next();
    next();
  }
  // Uses the hash of a name, such as a case's id, as the seed.
  explicit Random(std::string_view id) : Random(hash(id), 0) {}
  // FNV-1a with 64 bits.
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
  // Returns one of 0 .. n-1. The bias of the remainder is below 2^-50, because n is small.
  int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
  int between(int lo, int hi) { return lo + below(hi - lo + 1); }
  bool one_in(int n) { return below(n) == 0; }
  // unit() returns a multiple of 2^-30 in [0, 1), signed_unit() a multiple of 2^-29 in [-1, 1).
  // The sum of a few such numbers is exact.
  double unit() { return static_cast<double>(next() >> 34) * 0x1p-30; }
  double signed_unit() { return 2 * unit() - 1; }
  // Returns a multiple of 2^-52 in [-1, 1).
  double full_mantissa() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1; }

 private:
  std::uint64_t state_;
};

// Draws one item of a list. REQUIRES a list that is not empty.
template <class List>
auto& one_of(Random& random, List& list) {
  return list[static_cast<std::size_t>(random.below(static_cast<int>(std::size(list))))];
}

// Returns the list in a random order (the shuffle of Fisher and Yates).
template <class List>
List shuffled(Random& random, List list) {
  for (std::size_t i = list.size(); i > 1; --i) {
    const auto other = static_cast<std::size_t>(random.below(static_cast<int>(i)));
    std::swap(list[i - 1], list[other]);
  }
  return list;
}

// Rotates the corners of each triangle, so that a random corner comes first.
template <class Triangles>
void begin_anywhere(Random& random, Triangles&& triangles) {
  for (auto&& corners : triangles)
    std::rotate(corners.begin(), corners.begin() + random.below(3), corners.end());
}

}  // namespace assay::properties
