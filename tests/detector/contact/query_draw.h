// Random queries of the elementary test.
#pragma once

#include <cmath>
#include <random>

#include "detector/mesh/step_types.h"

namespace assay::tests {

class QueryDraw {
 public:
  explicit QueryDraw(std::uint64_t seed) : engine_(seed) {}
  int between(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }
  // Returns a number in [-1/2, 1/2) whose mantissa is full.
  double full() { return std::ldexp(static_cast<double>(engine_() >> 11), -53) - .5; }
  // Returns a vertex-face or an edge-edge query. coordinate() draws each of its 24 coordinates.
  template <class Coordinate>
  detector::FourPoints query(Coordinate coordinate) {
    detector::FourPoints q;
    q.first_group = between(1, 2);
    for (auto& p : q.points) {
      for (std::size_t k = 0; k < 3; ++k) {
        p.t0[k] = coordinate();
        p.t1[k] = coordinate();
      }
    }
    return q;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace assay::tests
