#include <algorithm>
#include <cmath>

#include "corpus/scenes/shapes.h"
#include "corpus/scenes/trigonometry.h"
#include "properties/generators/sizes/large_shapes.h"

namespace assay::properties {
namespace {

using corpus::add_sheet;
using corpus::cos_turn;
using corpus::CubicGrid;
using corpus::nearest_resolution;
using corpus::sin_turn;

// A wavy sheet of about so many triangles under `height`, which moves a little.
void add_ground(Draft& draft, Points& end, Random& random, int triangles, double height) {
  const int cells = nearest_resolution(triangles, 1, [](int k) { return 2 * k * k; });
  const double phase = random.unit();
  const auto first = draft.vertices();
  add_sheet(draft, cells, cells, [&](int k, int i) {
    return Point{1. * k, 1. * i, height + 0.1 * sin_turn(0.07 * (k + i) + phase)};
  });
  for (auto v = first; v < draft.vertices(); ++v) {
    const Point noise = any_point(random, 0.02);
    end.push_back(at(draft.rest(), v) + noise);
  }
}

// Moves the vertices from `first` on.
void move_all(const Draft& draft, Points& end, std::int32_t first, const Point& by) {
  for (auto v = first; v < draft.vertices(); ++v) end.push_back(at(draft.rest(), v) + by);
}

}  // namespace

Draft contact_in_a_far_corner(Random& random, int triangles) {
  constexpr double size = 0.3, above = 2;
  Draft draft;
  draft.frames.emplace_back();
  Points end;
  add_ground(draft, end, random, triangles - 4, 0);
  const double corner = draft.rest().back()[0];
  const auto first = draft.vertices();
  const double x = corner - 0.5 - random.unit(), y = corner - 0.5 - random.unit();
  const Point tilt = any_point(random, 0.4);
  add_tetrahedron(draft, {x, y, above}, size, tilt);
  move_all(draft, end, first, {0, 0, -above * (0.8 + 0.4 * random.unit())});
  draft.frames.push_back(std::move(end));
  return draft;
}

Draft many_components(Random& random, int triangles) {
  constexpr double pitch = 3, size = 0.5;
  constexpr int every = 50;
  const int bodies = triangles / 4;
  const CubicGrid grid(bodies, pitch);
  Draft draft;
  draft.frames.emplace_back();
  Points end;
  for (int body = 0; body < bodies; ++body) {
    const Point cell = grid.cell(body);
    const auto first = draft.vertices();
    const Point tilt = any_point(random, 0.4);
    add_tetrahedron(draft, cell, size, tilt);
    const bool meets = body % every == every - 1;
    const Point aside = any_point(random, 0.2);
    move_all(draft, end, first, aside + Point{meets ? -pitch : 0., 0, 0});
  }
  draft.frames.push_back(std::move(end));
  return draft;
}

Draft bodies_to_one_point(Random& random, int triangles) {
  const int pairs = std::min(random.between(44, 60), triangles / 16);
  Draft draft;
  draft.frames.emplace_back();
  Points end;
  add_ground(draft, end, random, triangles - 8 * pairs, -4);
  for (int i = 0; i < pairs; ++i) {
    const double scale = std::ldexp(1, -i);
    const Point lower = scale * Point{1, 1, 1}, upper = scale * Point{1, 1, 1.5};
    for (const bool falls : {false, true}) {
      const auto first = draft.vertices();
      const Point tilt = any_point(random, 0.4);
      add_tetrahedron(draft, falls ? upper : lower, 0.1 * scale, tilt);
      const Point aside = any_point(random, 0.02);
      move_all(draft, end, first, scale * (aside + Point{0, 0, falls ? -0.4 : 0.}));
    }
  }
  draft.frames.push_back(std::move(end));
  return draft;
}

Draft vertex_of_high_valence(Random& random, int triangles) {
  const int spokes = std::min(1000, triangles);
  constexpr double radius = 8, height = 3;
  Draft draft;
  draft.frames.emplace_back();
  Points end;
  // Every tenth vertex of the rim goes past those beside it, and its triangles through theirs.
  const auto apex = draft.vertex({0, 0, height});
  end.push_back({0.1 * random.signed_unit(), 0, height});
  const auto first = draft.vertices();
  for (int k = 0; k < spokes; ++k) {
    const double turn = static_cast<double>(k) / spokes, rise = 0.05 * (k % 2);
    draft.vertex({radius * cos_turn(turn), radius * sin_turn(turn), rise});
    const double to = turn + (k % 10 == 5 ? 2.5 * random.signed_unit() : 0.) / spokes;
    const double lift = 0.1 * random.signed_unit();
    end.push_back({radius * cos_turn(to), radius * sin_turn(to), rise + lift});
  }
  for (int k = 0; k < spokes; ++k)
    draft.faces.push_back({apex, first + k, first + (k + 1) % spokes});
  if (const int rest = triangles - spokes; rest >= 2) add_ground(draft, end, random, rest, -4);
  draft.frames.push_back(std::move(end));
  return draft;
}

Draft breathing_sphere(Random& random, int triangles) {
  auto mesh = corpus::sphere_shape(triangles);
  // Edges of the order of 1.
  const double radius = std::sqrt(static_cast<double>(triangles)) / 4;
  const double breath = 0.5 + random.unit(), phase = random.unit();
  Draft draft;
  draft.frames.resize(2);
  draft.star_shaped = true;
  for (const auto& x : mesh.positions.rowwise()) {
    const Point p = {radius * x[0], radius * x[1], radius * x[2]};
    draft.frames[0].push_back(p);
    const double by = breath * (1 + 0.1 * sin_turn(0.5 * x[2] + phase));
    draft.frames[1].push_back(by * p);
  }
  for (const auto& f : mesh.triangles.rowwise()) draft.faces.push_back({f[0], f[1], f[2]});
  return draft;
}

}  // namespace assay::properties
