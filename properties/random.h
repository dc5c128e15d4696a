// Integer-only random numbers: the standard distributions differ between libraries.
#pragma once

#include <cstdint>

namespace assay::properties {

// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index) : state_(seed ^ (index * 0xd1342543de82ef95u)) {
    next();
    next();
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

 private:
  std::uint64_t state_;
};

}  // namespace assay::properties
