
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "corpus/scenes/shapes.h"

namespace assay::corpus {

namespace {

using detector::Point;

// Returns numbers in [0,1) that are spread evenly, another series for each `salt`. If all parts
// were alike, they would meet everywhere at one time.
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
    add_sheet(maker, {cells, cells}, [&](int k, int i) {
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
    add_sheet(maker, {1, pieces}, [&](int k, int i) {
      const double u = static_cast<double>(i) / pieces;
      const double waves = wave * u * sin_turn(2 * u + own);
      return Point{pitch * column + curl * u * u + s * (to_the_side * u * u + waves),
                   pitch * row + width * (k - 0.5) + s * across * u * u, -length * u};
    });
  }
  return maker.mesh();
}

// A box with an arm.
namespace {

constexpr double half_width = 0.1;                 // of the arm
constexpr double bend_radius = 0.3;                // of the arm's three bends
constexpr double out = 0.4, up = 1.4, over = 1.1;  // lengths of its straight parts
constexpr double arc = bend_radius * pi / 2;
constexpr double fixed_length = out + up + over + 3 * arc;
constexpr double shoulder = 1.7;  // height from which the arm goes straight down

// A place on the arm's middle line, which lies in the plane y = 0: its point, its direction, and
// the direction that continues the wall's +z. All are (x, z).
struct Station {
  double x, z, direction_x, direction_z, side_x, side_z;
};

// Returns the station at a length s in [0, fixed_length] along the line: out of the wall at (-1,
// 0), up, over the lid, down to the shoulder.
Station station_at(double s) {
  double x = -1, z = 0, turn = 0;  // turn: how far the direction has gone from -x over +z to +x
  const std::array<double, 3> straight = {out, up, over};
  for (const double length : straight) {
    const double c = cos_turn(turn), d = sin_turn(turn);
    const double along = s < length ? s : length;
    x -= along * c;
    z += along * d;
    s -= along;
    if (s <= 0) break;
    const double part = (s < arc ? s : arc) / arc / 4;
    // The bend's centre lies a quarter turn on from the direction.
    const double centre_x = x + bend_radius * d, centre_z = z + bend_radius * c;
    turn += part;
    x = centre_x - bend_radius * sin_turn(turn);
    z = centre_z - bend_radius * cos_turn(turn);
    s -= s < arc ? s : arc;
  }
  const double c = cos_turn(turn), d = sin_turn(turn);
  return {x, z, -c, d, d, c};
}

constexpr int edges_across_arm(int b) { return b < 3 ? 1 : b / 3; }

// Returns the perimeter of a square of k x k edges in 4 k steps, clockwise from its first corner,
// which is right-handed about the arm's direction.
std::vector<std::array<int, 2>> perimeter(int k) {
  std::vector<std::array<int, 2>> points;
  for (int i = 0; i < k; ++i) points.push_back({0, i});
  for (int i = 0; i < k; ++i) points.push_back({i, k});
  for (int i = 0; i < k; ++i) points.push_back({k, k - i});
  for (int i = 0; i < k; ++i) points.push_back({k - i, 0});
  return points;
}

// Returns the first edge of a block of k in the middle of the 3 b edges of a side.
constexpr int first_of_block(int b, int k) { return (3 * b - k) / 2; }

// The vertices of the box by their lattice place, 0 ... 3 b on each axis.
class BoxSurface {
 public:
  BoxSurface(MeshMaker& maker, int b) : maker_(maker), b_(b) {}

  std::int32_t vertex(const std::array<int, 3>& place) {
    const auto [entry, is_new] = numbers_.try_emplace(place, 0);
    if (is_new) {
      const auto coordinate = [&](int i) { return 2.0 * i / (3 * b_) - 1; };
      entry->second =
          maker_.vertex({coordinate(place[0]), coordinate(place[1]), coordinate(place[2])});
    }
    return entry->second;
  }

  // Adds one side, without the block in its middle that is `open` edges wide.
  void side(std::size_t axis, bool high, int open) {
    const int first = first_of_block(b_, open);
    const auto in_block = [&](int i) { return i >= first && i < first + open; };
    for (int i = 0; i < 3 * b_; ++i) {
      for (int j = 0; j < 3 * b_; ++j) {
        if (in_block(i) && in_block(j)) continue;
        const auto corner = [&](int di, int dj) {
          std::array<int, 3> place{};
          place[axis] = high ? 3 * b_ : 0;
          place[(axis + 1) % 3] = i + di;
          place[(axis + 2) % 3] = j + dj;
          return vertex(place);
        };
        if (high) {
          maker_.quad(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
        } else {
          maker_.quad(corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0));
        }
      }
    }
  }

 private:
  MeshMaker& maker_;
  int b_;
  std::map<std::array<int, 3>, std::int32_t> numbers_;
};

// Adds a ring of the arm around a station.
std::vector<std::int32_t> add_ring(MeshMaker& maker, const Station& at, int k) {
  std::vector<std::int32_t> ring;
  for (const auto& [i, j] : perimeter(k)) {
    const double u = half_width * (2.0 * i / k - 1), v = half_width * (2.0 * j / k - 1);
    ring.push_back(maker.vertex({at.x + v * at.side_x, u, at.z + v * at.side_z}));
  }
  return ring;
}

void join(MeshMaker& maker, const std::vector<std::int32_t>& a,
          const std::vector<std::int32_t>& b) {
  for (std::size_t j = 0; j < a.size(); ++j) {
    const std::size_t next = (j + 1) % a.size();
    maker.quad(a[j], a[next], b[next], b[j]);
  }
}

constexpr int fixed_rings(int b) { return 7 * b + 1; }
constexpr int sliding_rings(int b) { return 3 * b; }

constexpr int triangle_count(int b) {
  const int k = edges_across_arm(b);
  return 106 * b * b + 80 * b * k - 2 * k * k + 12 * k;
}

// Returns the height of sliding ring i = 1 ... n. The tip is a point, half a width below the last
// ring.
double ring_height(int i, int n, double tip) {
  return shoulder + (tip + half_width - shoulder) * i / n;
}

}  // namespace

BoxWithArm::BoxWithArm(int size) : resolution_(nearest_resolution(size, 1, triangle_count)) {
  const int b = resolution_, k = edges_across_arm(b), root = first_of_block(b, k);
  MeshMaker maker;
  BoxSurface box(maker, b);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.side(axis, false, axis == 0 ? k : 0);
    box.side(axis, true, axis == 2 ? b : 0);
  }
  std::vector<std::int32_t> ring;
  for (const auto& [i, j] : perimeter(k)) ring.push_back(box.vertex({0, root + i, root + j}));
  for (int i = 1; i <= fixed_rings(b); ++i) {
    auto next = add_ring(maker, station_at(fixed_length * i / fixed_rings(b)), k);
    join(maker, ring, next);
    ring = std::move(next);
  }
  for (int i = 1; i <= sliding_rings(b); ++i) {
    const double z = ring_height(i, sliding_rings(b), tip_outside);
    auto next = add_ring(maker, {0, z, 0, -1, -1, 0}, k);
    if (i == 1) first_sliding_ = next.front();
    join(maker, ring, next);
    ring = std::move(next);
  }
  const std::int32_t tip = maker.vertex({0, 0, tip_outside});
  for (std::size_t j = 0; j < ring.size(); ++j) {
    maker.triangle(tip, ring[j], ring[(j + 1) % ring.size()]);
  }
  mesh = maker.mesh();
}

detector::Positions BoxWithArm::with_tip(double z) const {
  detector::Positions x = mesh.positions;
  const int rings = sliding_rings(resolution_), around = 4 * edges_across_arm(resolution_);
  for (int i = 1; i <= rings; ++i) {
    x.middleRows(first_sliding_ + (i - 1) * around, around)
        .col(2)
        .setConstant(ring_height(i, rings, z));
  }
  x(x.rows() - 1, 2) = z;
  return x;
}

}  // namespace assay::corpus
