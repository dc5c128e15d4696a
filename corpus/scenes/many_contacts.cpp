#include "corpus/scenes/many_contacts.h"

#include <algorithm>
#include <cmath>

#include "corpus/scenes/shapes.h"
#include "corpus/scenes/trigonometry.h"

namespace assay::corpus {
namespace {

using detector::Point;

// Numbers in [0,1) that are spread evenly, another series for each `salt`: what is alike all over
// would meet everywhere at one time.
double spread(int i, int salt) {
  constexpr double steps[] = {0.61803398874989485, 0.7548776662466927, 0.56984029099805327,
                              0.81917251339616438};
  const double x = steps[salt] * (i + 1);
  return x - std::floor(x);
}

Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point unit(const Point& a) { return (1 / std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])) * a; }

// Turns x about the z axis, then about the x axis, by parts of a turn.
Point turned(const Point& x, double about_z, double about_x) {
  const double c = cos_turn(about_z), d = sin_turn(about_z);
  const Point y = {c * x[0] - d * x[1], d * x[0] + c * x[1], x[2]};
  const double e = cos_turn(about_x), f = sin_turn(about_x);
  return {y[0], e * y[1] - f * y[2], f * y[1] + e * y[2]};
}

}  // namespace

Mesh layered_cloth(int size, double s) {
  constexpr int most_layers = 50, least_of_a_layer = 32;
  constexpr double gap = 0.02, fold = 0.15, bulge = 2 * gap, slide = gap;
  const int layers = std::clamp(size / least_of_a_layer, 2, most_layers);
  const int cells = nearest_resolution(size / layers, 1, [](int n) { return 2 * n * n; });
  MeshMaker maker;
  for (int layer = 0; layer < layers; ++layer) {
    const double phase = spread(layer, 0), way = spread(layer, 1);
    const Point slid = {slide * s * cos_turn(way), slide * s * sin_turn(way), gap * layer};
    add_sheet(maker, cells, cells, [&](int k, int i) {
      const double x = 2. * k / cells - 1, y = 2. * i / cells - 1;
      const double folded = fold * sin_turn(0.4 * x + 0.1) * cos_turn(0.35 * y);
      const double bulged = bulge * s * sin_turn(0.9 * x + phase) * cos_turn(1.1 * y + way);
      return Point{x, y, folded + bulged} + slid;
    });
  }
  return maker.mesh();
}

Mesh pile_of_bodies(int size, double s) {
  constexpr int of_a_body = 80;
  constexpr double pitch = 1.2, most_radius = 0.5, least_radius = 0.4, aside = 0.05;
  constexpr double drawn_together = 0.3, turns = 0.1;
  const int bodies = std::max(2, (size + of_a_body / 2) / of_a_body);
  const CubicGrid grid(bodies, pitch);
  const Mesh sphere = sphere_shape(of_a_body);
  MeshMaker maker;
  for (int body = 0; body < bodies; ++body) {
    const double radius = most_radius - (most_radius - least_radius) * spread(body, 0);
    const Point off = {2 * spread(body, 1) - 1, 2 * spread(body, 2) - 1, 2 * spread(body, 3) - 1};
    const Point centre = (1 - drawn_together * s) * (grid.cell(body) + aside * off);
    std::int32_t first = 0;
    for (std::int32_t v = 0; v < sphere.positions.rows(); ++v) {
      const Point x = turned(detector::point_of(sphere.positions, v), spread(body, 1) + turns * s,
                             spread(body, 2) - turns * s);
      const auto vertex = maker.vertex(centre + radius * x);
      if (v == 0) first = vertex;
    }
    for (const auto& t : sphere.triangles.rowwise())
      maker.triangle(first + t[0], first + t[1], first + t[2]);
  }
  return maker.mesh();
}

Mesh tightening_knot(int size, double s) {
  constexpr double radius = 0.35, drawn_together = 0.6;
  constexpr int least_along = 24;
  const int around = nearest_resolution(size, 3, [](int n) { return 24 * n * n; });
  const int along = std::max(least_along, (size + around) / (2 * around));
  const double scale = 1 - drawn_together * s;
  MeshMaker maker;
  for (int i = 0; i < along; ++i) {
    const double u = static_cast<double>(i) / along;
    const Point middle = {sin_turn(u) + 2 * sin_turn(2 * u), cos_turn(u) - 2 * cos_turn(2 * u),
                          -sin_turn(3 * u)};
    // The way along the knot is nowhere upright, so one side of the tube can always lie level.
    const Point ahead = unit({cos_turn(u) + 4 * cos_turn(2 * u), 4 * sin_turn(2 * u) - sin_turn(u),
                              -3 * cos_turn(3 * u)});
    const Point level = unit(cross({0, 0, 1}, ahead)), upward = cross(ahead, level);
    for (int k = 0; k < around; ++k) {
      const double turn = static_cast<double>(k) / around;
      maker.vertex(scale * middle + radius * (cos_turn(turn) * level + sin_turn(turn) * upward));
    }
  }
  const auto at = [&](int i, int k) { return i % along * around + k % around; };
  for (int i = 0; i < along; ++i) {
    for (int k = 0; k < around; ++k)
      maker.quad(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
  }
  return maker.mesh();
}

Mesh combed_hair(int size, double s) {
  constexpr int pieces = 24, of_a_strip = 2 * pieces;
  constexpr double pitch = 0.06, width = 0.03, length = 1;
  constexpr double combed = 0.3, lean = 0.15, stray = 0.03, wave = 0.002, curl = 0.1;
  const int strips = std::max(2, (size + of_a_strip / 2) / of_a_strip);
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(strips))));
  MeshMaker maker;
  for (int strip = 0; strip < strips; ++strip) {
    const int column = strip % side, row = strip / side;
    const double own = spread(strip, 0), across = stray * (2 * spread(strip, 1) - 1);
    const double to_the_side = combed + (column % 2 == 0 ? lean : -lean);
    add_sheet(maker, 1, pieces, [&](int k, int i) {
      const double u = static_cast<double>(i) / pieces;
      const double waves = wave * u * sin_turn(2 * u + own);
      return Point{pitch * column + curl * u * u + s * (to_the_side * u * u + waves),
                   pitch * row + width * (k - 0.5) + s * across * u * u, -length * u};
    });
  }
  return maker.mesh();
}

}  // namespace assay::corpus
