// Random numbers that are made from integers alone, because the standard distributions differ
// between libraries.
#pragma once

#include "detector/mesh/step_types.h"
#include "tests/asked.h"
#include "tests/test.h"

namespace assay::oracle::test {

// The generator splitmix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t x = state_;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
  }
  // Returns an integer in [0, n). The bias does not matter, because n is far below 2^64.
  int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
  // Returns an integer in [-n, n].
  double integer(int n) { return below(2 * n + 1) - n; }
  // Returns a multiple of 2^-52 in [-1, 1).
  double unit() { return std::ldexp(static_cast<double>(next() >> 11), -52) - 1; }

 private:
  std::uint64_t state_;
};

// Kinds of coordinates: generic, degenerate, or nearly degenerate.
enum class Coordinates { generic, tiny_grid, grid_and_noise, ulp_neighbours, far, mixed_scales };
constexpr int coordinate_kinds = 6;

inline double random_coordinate(Random& random, Coordinates kind) {
  switch (kind) {
    case Coordinates::generic:
      return random.unit();
    case Coordinates::tiny_grid:
      return random.integer(2);
    case Coordinates::grid_and_noise:
      return random.integer(2) + std::ldexp(random.unit(), -40);
    case Coordinates::ulp_neighbours:
      return random.integer(2) * (1 + std::ldexp(random.below(3), -52));
    case Coordinates::far:
      return 1e6 + random.unit();
    case Coordinates::mixed_scales:
      return std::ldexp(random.integer(4), random.below(40) - 20);
  }
  return 0;
}

inline detector::MovingPoint random_point(Random& random, Coordinates kind) {
  detector::MovingPoint p;
  for (int k = 0; k < 3; ++k) {
    p.t0[k] = random_coordinate(random, kind);
    p.t1[k] = random_coordinate(random, kind);
  }
  return p;
}

// Returns the positions of points at rest.
inline detector::Positions random_rows(Random& random, Coordinates kind, Eigen::Index count) {
  detector::Positions x(count, 3);
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = random_coordinate(random, kind);
  return x;
}

// Draws the positions at the start and at the end of a step.
inline void place_randomly(Random& random, Coordinates kind, Eigen::Index vertices,
                           detector::Positions& x_t0, detector::Positions& x_t1) {
  x_t0.resize(vertices, 3);
  x_t1.resize(vertices, 3);
  for (Eigen::Index i = 0; i < 3 * vertices; ++i) {
    x_t0.data()[i] = random_coordinate(random, kind);
    x_t1.data()[i] = random_coordinate(random, kind);
  }
}

// `any_triangles` draws each corner alone, so a triangle can have one vertex twice.
// `random_triangles` returns only triangles with three different vertices.
inline detector::Triangles any_triangles(Random& random, int vertices, int count) {
  detector::Triangles f(count, 3);
  for (Eigen::Index i = 0; i < f.size(); ++i) f.data()[i] = random.below(vertices);
  return f;
}
inline detector::Triangles random_triangles(Random& random, int vertices, int count) {
  detector::Triangles f(count, 3);
  for (int t = 0; t < count; ++t) {
    do {
      f.row(t) = any_triangles(random, vertices, 1);
    } while (f(t, 0) == f(t, 1) || f(t, 1) == f(t, 2) || f(t, 2) == f(t, 0));
  }
  return f;
}

inline detector::MovingPoint rest(const detector::Point& p) { return {p, p}; }

// A triangle at rest in the plane z = 0.
inline const std::array<detector::MovingPoint, 3> resting_face = {rest({0, 0, 0}), rest({4, 0, 0}),
                                                                  rest({0, 4, 0})};

}  // namespace assay::oracle::test
