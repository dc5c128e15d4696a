#include "corpus/scenes/shapes.h"

#include <cmath>
#include <compare>
#include <iterator>
#include <map>

namespace assay::corpus {

namespace {

using detector::Point;

// Vertices of an icosahedron and its outward faces.
const double golden = (1 + std::sqrt(5.0)) / 2;
const std::array<Point, 12> ico_vertices = {{{-1, golden, 0},
                                             {1, golden, 0},
                                             {-1, -golden, 0},
                                             {1, -golden, 0},
                                             {0, -1, golden},
                                             {0, 1, golden},
                                             {0, -1, -golden},
                                             {0, 1, -golden},
                                             {golden, 0, -1},
                                             {golden, 0, 1},
                                             {-golden, 0, -1},
                                             {-golden, 0, 1}}};
constexpr std::array<std::array<int, 3>, 20> ico_faces = {
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

// A vertex of a split face: its weight for each corner of the face, by ascending corner.
struct Weighted {
  int corner, weight;
  friend auto operator<=>(const Weighted&, const Weighted&) = default;
};
using Weights = std::array<Weighted, 3>;

Point on_sphere(const Weights& weights) {
  Point x{};
  for (const auto& [corner, weight] : weights) {
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] += weight * ico_vertices[static_cast<std::size_t>(corner)][k];
    }
  }
  const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  return {x[0] / length, x[1] / length, x[2] / length};
}

// The key by which neighbouring faces know the vertices of their common edge: the weights without
// those that are zero.
using Shared = std::vector<Weighted>;

// Returns the rectangle between two corners in the plane z = 0: columns x rows squares of two
// triangles.
Mesh grid(int columns, int rows, const Point& lo, const Point& hi) {
  MeshMaker maker;
  add_sheet(maker, {.columns = rows, .rows = columns, .is_turned = true}, [&](int j, int i) {
    return Point{(hi[0] - lo[0]) * i / columns + lo[0], (hi[1] - lo[1]) * j / rows + lo[1], 0};
  });
  return maker.mesh();
}

}  // namespace

Mesh sphere_shape(int size) {
  const int f = nearest_resolution(size, 1, [](int n) { return 20 * n * n; });
  MeshMaker maker;
  std::map<Shared, std::int32_t> numbers;
  std::vector<std::int32_t> of_face;
  for (const auto& [a, b, c] : ico_faces) {
    constexpr std::int32_t none = -1;
    of_face.assign(static_cast<std::size_t>((f + 1) * (f + 1)), none);
    const auto vertex = [&, a = a, b = b, c = c](int i, int j) {
      std::int32_t& number = of_face[static_cast<std::size_t>(i * (f + 1) + j)];
      if (number != none) return number;
      Weights weights = {{{a, f - i - j}, {b, i}, {c, j}}};
      std::sort(weights.begin(), weights.end());
      Shared shared;
      std::copy_if(weights.begin(), weights.end(), std::back_inserter(shared),
                   [](const Weighted& one) { return one.weight > 0; });
      if (shared.size() == weights.size()) return number = maker.vertex(on_sphere(weights));
      const auto [place, is_new] = numbers.try_emplace(shared, 0);
      if (is_new) place->second = maker.vertex(on_sphere(weights));
      return number = place->second;
    };
    for (int i = 0; i < f; ++i) {
      for (int j = 0; i + j < f; ++j) {
        maker.triangle(vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
        if (i + j + 1 < f) {
          maker.triangle(vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
        }
      }
    }
  }
  return maker.mesh();
}

Mesh tube_shape(int size, bool capped) {
  constexpr double radius = 0.5, length = 6;
  const int m =
      nearest_resolution(size, 3, [&](int n) { return 4 * n * n + (capped ? 2 * n : 0); });
  const int rows = 2 * m;
  MeshMaker maker;
  add_sheet(maker, {.columns = m, .rows = rows, .is_round = true}, [&](int j, int i) {
    const double turn = static_cast<double>(j) / m;
    return Point{radius * cos_turn(turn), radius * sin_turn(turn), length * i / rows - length / 2};
  });
  if (capped) {
    const auto at = [m](int i, int j) { return i * m + j % m; };
    const auto bottom = maker.vertex({0, 0, -length / 2});
    const auto top = maker.vertex({0, 0, length / 2});
    for (int j = 0; j < m; ++j) {
      maker.triangle(bottom, at(0, j + 1), at(0, j));
      maker.triangle(top, at(rows, j), at(rows, j + 1));
    }
  }
  return maker.mesh();
}

Mesh torus_shape(int size) {
  constexpr double wide = 1, thin = 0.4;
  const int m = nearest_resolution(size, 3, [](int n) { return 4 * n * n; });
  const int rows = 2 * m;
  MeshMaker maker;
  add_sheet(maker, {m, rows, true, true, true}, [&](int j, int i) {
    const double around = static_cast<double>(i) / rows, turn = static_cast<double>(j) / m;
    const double r = wide + thin * cos_turn(turn);
    return Point{r * cos_turn(around), r * sin_turn(around), thin * sin_turn(turn)};
  });
  return maker.mesh();
}

Mesh sheet_shape(int size) {
  const int k = nearest_resolution(size, 1, [](int n) { return 2 * n * n; });
  return grid(k, k, {-1, -1, 0}, {1, 1, 0});
}

Mesh ribbon_shape(int size) {
  const int k = nearest_resolution(size, 1, [](int n) { return 16 * n * n; });
  return grid(8 * k, k, {0, 0, 0}, {1, 0.5, 0});
}

Mesh side_by_side(const Mesh& a, const Mesh& b, double offset) {
  Mesh both;
  both.positions.resize(a.positions.rows() + b.positions.rows(), 3);
  both.positions << a.positions, b.positions;
  both.positions.bottomRows(b.positions.rows()).col(0).array() += offset;
  both.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
  both.triangles << a.triangles, b.triangles;
  both.triangles.bottomRows(b.triangles.rows()).array() +=
      static_cast<std::int32_t>(a.positions.rows());
  return both;
}

namespace {

// Returns sin(a) for |a| <= pi/4. The first term left out, a^17/17!, is below 5e-17.
double sin_small(double a) {
  const double s = a * a;
  double sum = 0;
  for (int k = 15; k >= 3; k -= 2) sum = (sum + 1.0) * (-s / (k * (k - 1)));
  return a + a * sum;
}

// Returns cos(a) for |a| <= pi/4. The first term left out, a^18/18!, is below 3e-18.
double cos_small(double a) {
  const double s = a * a;
  double sum = 0;
  for (int k = 16; k >= 2; k -= 2) sum = (sum + 1.0) * (-s / (k * (k - 1)));
  return 1.0 + sum;
}

// Returns the sine of x turns and `shift` quarters of a turn.
double shifted_sine(double x, int shift) {
  // Both subtractions are exact: the rest is x less the nearest multiple of a quarter.
  const double quarters = std::floor(4 * x + 0.5);
  const double a = 2 * pi * (x - quarters / 4);
  const int quarter = static_cast<int>(quarters - 4 * std::floor(quarters / 4)) + shift;
  switch (quarter % 4) {
    case 0:
      return sin_small(a);
    case 1:
      return cos_small(a);
    case 2:
      return -sin_small(a);
    default:
      return -cos_small(a);
  }
}

}  // namespace

double sin_turn(double x) { return shifted_sine(x, 0); }

double cos_turn(double x) { return shifted_sine(x, 1); }

}  // namespace assay::corpus
