#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "corpus/scenes/shapes.h"
#include "properties/generators/parts.h"
#include "properties/random.h"

namespace assay::properties {

namespace {

void scale_and_move(Draft& d, double scale, const Point& by) {
  for (auto& p : d.rest()) p = scale * p + by;
}

// Returns the least and the greatest x of the draft.
std::array<double, 2> extent(const Draft& d) {
  const auto [low, high] = std::minmax_element(
      d.rest().begin(), d.rest().end(), [](const Point& a, const Point& b) { return a[0] < b[0]; });
  return {(*low)[0], (*high)[0]};
}

// Makes two pieces side by side along x, with a gap from a hair to half a unit.
Draft two_pieces(Random& random, int size) {
  Draft a = simple_shape(random, size / 2), b = simple_shape(random, size / 2);
  const double gap = random.between(1, 32) / 64.0;
  scale_and_move(b, 1, {extent(a)[1] - extent(b)[0] + gap, 0, 0});
  Draft d = joined(std::move(a), b);
  d.tag("pieces:apart");
  return d;
}

Draft nested(Random& random, int size, bool inward) {
  Draft a = star_shape(random, std::max(4, size / 2)), b = star_shape(random, size / 2);
  double inner = 1e9, outer = 0;
  for (const auto& p : a.rest()) inner = std::min(inner, dot(p, p));
  for (const auto& p : b.rest()) outer = std::max(outer, dot(p, p));
  scale_and_move(b, random.between(1, 3) / 8.0 * std::sqrt(inner / outer), {0, 0, 0});
  if (inward) {
    for (auto& f : b.faces) std::swap(f[1], f[2]);
  }
  Draft d = joined(std::move(a), b);
  d.tag(inward ? "pieces:cavity" : "pieces:nested");
  return d;
}

// Makes two pieces: the highest vertex of one along x is the lowest of the other.
Draft sharing_a_vertex(Random& random, int size) {
  Draft a = simple_shape(random, size / 2), b = simple_shape(random, size / 2);
  std::int32_t high = 0, low = 0;
  for (std::int32_t v = 0; v < a.vertices(); ++v) {
    if (at(a.rest(), v)[0] > at(a.rest(), high)[0]) high = v;
  }
  for (std::int32_t v = 0; v < b.vertices(); ++v) {
    if (at(b.rest(), v)[0] < at(b.rest(), low)[0]) low = v;
  }
  scale_and_move(b, 1, at(a.rest(), high) - at(b.rest(), low));
  const std::int32_t first_vertex = high, second_vertex = a.vertices() + low;
  Draft d = joined(std::move(a), b);
  for (auto& f : d.faces) std::ranges::replace(f, second_vertex, first_vertex);
  drop_unused_vertices(d);
  d.tag("pieces:at-a-vertex");
  return d;
}

// Makes two tetrahedra that share an edge. They lie beside each other, or one within the other.
Draft sharing_an_edge(Random& random, int) {
  Draft d;
  const double side = random.below(3) == 0 ? 1 : -1;
  d.frames.push_back({{0, 0, -1},
                      {0, 0, 1},
                      {2, -1.5, 0},
                      {2, 1.5, 0},
                      {side * 1, -side * 0.375, 0},
                      {side * 1.25, side * 0.25, 0}});
  d.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3},
             {0, 4, 1}, {0, 1, 5}, {0, 5, 4}, {1, 4, 5}};
  // The order above is outward for one orientation of the axes only.
  Point centre = mean({d.rest()[0], d.rest()[1], d.rest()[2], d.rest()[3]});
  const auto& x = d.rest();
  if (dot(x[0] - centre, cross(x[2] - x[0], x[1] - x[0])) < 0) {
    for (auto& f : d.faces) std::swap(f[1], f[2]);
  }
  d.second_piece = 4;
  d.tag("pieces:at-an-edge");
  d.tag("shape:tetrahedron");
  return d;
}

}  // namespace

Draft closed_shape(Random& random, int size) {
  const int kind = random.below(13);
  if (size < 8 || kind < 7) return simple_shape(random, size);
  switch (kind) {
    case 7:
      return nested(random, size, true);
    case 8:
      return nested(random, size, false);
    case 9:
      return sharing_a_vertex(random, size);
    case 10:
      return size <= 16 ? sharing_an_edge(random, size) : sharing_a_vertex(random, size);
    default:
      return two_pieces(random, size);
  }
}

namespace {

using corpus::cos_turn;
using corpus::sin_turn;

// Rings around the z axis from the bottom pole to the top one. `rings` gives the radius and the
// height of each.
Draft spindle(int sides, const std::vector<std::array<double, 2>>& rings, double pole) {
  Draft d;
  d.frames.emplace_back();
  const auto bottom = d.vertex({0, 0, -pole});
  for (const auto& [radius, height] : rings) {
    for (int j = 0; j < sides; ++j) {
      const double turn = static_cast<double>(j) / sides;
      d.vertex({radius * cos_turn(turn), radius * sin_turn(turn), height});
    }
  }
  const auto top = d.vertex({0, 0, pole});
  const auto ring = [sides](std::size_t i, int j) {
    return 1 + static_cast<std::int32_t>(i) * sides + j % sides;
  };
  for (int j = 0; j < sides; ++j) {
    d.faces.push_back({bottom, ring(0, j + 1), ring(0, j)});
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
      d.quad(ring(i, j), ring(i, j + 1), ring(i + 1, j + 1), ring(i + 1, j));
    }
    d.faces.push_back({top, ring(rings.size() - 1, j), ring(rings.size() - 1, j + 1)});
  }
  d.axis = {{{0, 0, -pole / 2}, {0, 0, pole / 2}}};
  d.star_shaped = true;
  return d;
}

// Chooses the numbers for 2 m n triangles with n rings of m vertices, where n is a little larger
// than half of m.
std::array<int, 2> rings_and_sides(int size) {
  int rings = 1;
  while (4 * (rings + 1) * (rings + 1) <= size) ++rings;
  return {rings, std::max(3, size / (2 * rings))};
}

Draft tetrahedron(Random&, int) {
  Draft d;
  d.frames.push_back({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
  d.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  d.axis = {{{-0.25, 0, 0}, {0.25, 0, 0}}};
  d.star_shaped = true;
  return d;
}

Draft bipyramid(Random& random, int size) {
  return spindle(std::clamp(size / 2, 3, 24), {{{1, 0}}}, random.between(2, 6) / 4.0);
}

Draft sphere(Random&, int size) {
  const auto [n, sides] = rings_and_sides(size);
  std::vector<std::array<double, 2>> rings;
  for (int i = 1; i <= n; ++i) {
    const double turn = 0.5 * i / (n + 1);
    rings.push_back({sin_turn(turn), -cos_turn(turn)});
  }
  return spindle(sides, rings, 1);
}

Draft capsule(Random& random, int size) {
  const int sides = size < 40 ? random.between(3, 4) : random.between(4, 6);
  const int n = std::max(2, size / (2 * sides));
  const double half = random.between(2, 4);
  std::vector<std::array<double, 2>> rings;
  for (int i = 0; i < n; ++i) rings.push_back({0.5, half * (2.0 * i / (n - 1) - 1)});
  return spindle(sides, rings, half + 0.25);
}

// Splits each triangle in four and moves the new vertices to the unit sphere.
Draft split_sphere(Random& random, int size) {
  Draft d = random.below(2) == 0 ? tetrahedron(random, 4) : spindle(4, {{{1, 0}}}, 1);
  while (static_cast<int>(d.faces.size()) * 4 <= std::max(size, 16)) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), 0);
      if (is_new) place->second = d.vertex(0.5 * (at(d.rest(), a) + at(d.rest(), b)));
      return place->second;
    };
    std::vector<Face> parts;
    for (const auto [a, b, c] : d.faces) {
      const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      parts.insert(parts.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    d.faces = std::move(parts);
  }
  for (auto& p : d.rest()) p = (1 / std::sqrt(dot(p, p))) * p;
  return d;
}

// Makes a star, in which hollows and tips alternate.
Draft star(Random& random, int size) {
  Draft d = sphere(random, std::max(size, 12));
  for (auto& p : d.rest()) p = (random.below(2) == 0 ? 0.5 : 1.0) * p;
  return d;
}

Draft torus(Random& random, int size) {
  const int sides = size < 60 ? 3 : random.between(3, 5);
  const int rows = std::max(3, size / (2 * sides));
  const double thin = random.between(2, 6) / 10.0;
  Draft d;
  d.frames.emplace_back();
  for (int i = 0; i < rows; ++i) {
    const double around = static_cast<double>(i) / rows;
    for (int j = 0; j < sides; ++j) {
      const double turn = static_cast<double>(j) / sides;
      const double r = 1 + thin * cos_turn(turn);
      d.vertex({r * cos_turn(around), r * sin_turn(around), thin * sin_turn(turn)});
    }
  }
  const auto place = [=](int i, int j) { return i % rows * sides + j % sides; };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < sides; ++j) {
      d.quad(place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1));
    }
  }
  d.axis = {{{1, 0, 0}, {-0.5, 0.75, 0}}};
  return d;
}

struct Shape {
  const char* name;
  Draft (*make)(Random&, int size);
  int least;  // triangles
};
constexpr Shape simple_shapes[] = {
    {"tetrahedron", tetrahedron, 4},
    {"bipyramid", bipyramid, 6},
    {"sphere", sphere, 6},
    {"split-sphere", split_sphere, 16},
    {"capsule", capsule, 12},
    {"star", star, 12},
    {"torus", torus, 18},
};

// Changes the proportions, and moves each vertex a little from its place.
void vary(Random& random, Draft& d) {
  Point stretch;
  for (double& s : stretch) s = 0.5 + random.unit();
  // With a larger share of the least edge, neighbours could pass each other.
  const double jitter = random.below(3) == 0 ? 0 : 0.25 / std::sqrt(d.faces.size());
  for (auto& p : d.rest()) {
    for (std::size_t k = 0; k < 3; ++k) p[k] = stretch[k] * (p[k] + jitter * random.signed_unit());
  }
  for (auto& end : d.axis) {
    for (std::size_t k = 0; k < 3; ++k) end[k] *= stretch[k];
  }
}

}  // namespace

Draft simple_shape(Random& random, int size) {
  std::vector<const Shape*> fitting;
  for (const auto& shape : simple_shapes) {
    // A tetrahedron has 4 triangles whatever size was wanted, so it is chosen for small sizes
    // only.
    if (shape.least <= size && (size <= 12 || shape.least > 4)) fitting.push_back(&shape);
  }
  const Shape& shape = *one_of(random, fitting);
  Draft d = shape.make(random, size);
  vary(random, d);
  d.tag(std::string("shape:") + shape.name);
  return d;
}

Draft star_shape(Random& random, int size) {
  for (;;) {
    Draft d = simple_shape(random, size);
    if (d.star_shaped) return d;
  }
}

}  // namespace assay::properties
