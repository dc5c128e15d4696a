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

}  // namespace

Draft layered_cloth(Random& random, int triangles) {
  constexpr double gap = 0.5;
  constexpr int layers = 8;
  const int cells = nearest_resolution(triangles / layers, 2, [](int k) { return 2 * k * k; });
  Draft draft;
  draft.frames.emplace_back();
  Points end;
  for (int layer = 0; layer < layers; ++layer) {
    const double phase = random.unit(), wave = 0.05 + 0.05 * random.unit(),
                 height = 0.8 + random.unit();
    const Point slide = any_point(random, 1);
    const auto first = draft.vertices();
    add_sheet(draft, cells, cells, [&](int k, int i) {
      return Point{static_cast<double>(k), static_cast<double>(i), gap * layer};
    });
    for (auto v = first; v < draft.vertices(); ++v) {
      Point x = at(draft.rest(), v);
      const double bulge = sin_turn(wave * x[0] + phase) * sin_turn(wave * x[1]);
      const Point noise = any_point(random, 0.2);
      end.push_back(x + Point{slide[0], slide[1], height * bulge} + noise);
    }
  }
  draft.frames.push_back(std::move(end));
  return draft;
}

Draft crumpled_sheet(Random& random, int triangles) {
  constexpr int wall = 8;  // cells from fold to fold
  constexpr double gap = 1;
  const int cells = nearest_resolution(triangles, 2 * wall, [](int k) { return 2 * k * k; });
  const double press = 0.25 + 0.2 * random.unit(), rough = 0.4 + 0.4 * random.unit();
  Draft draft;
  draft.frames.emplace_back();
  // Walls that stand upright side by side, joined by their lower and upper edges in turn.
  add_sheet(draft, cells, cells, [&](int k, int i) {
    const int period = wall + 1, pleat = k / period, along = k % period;
    const double height = pleat % 2 == 0 ? along : wall - along;
    return Point{gap * pleat, static_cast<double>(i), height};
  });
  Points end;
  for (const auto& x : draft.rest()) {
    const Point noise = any_point(random, rough);
    const double wave = sin_turn(0.03 * x[1] + 0.1 * x[2]);
    end.push_back(Point{press * x[0] + wave, x[1], 0.9 * x[2]} + noise);
  }
  // Moved to the middle of where it starts, so that no triangle sweeps far.
  const Point back = mean(draft.rest()) - mean(end);
  for (auto& x : end) x = x + back;
  const double width = gap * cells / (wall + 1);
  for (std::size_t v = 0; v < end.size(); ++v) {
    // What would sweep over more than a few walls stays nearer.
    const Point way = end[v] - draft.rest()[v];
    const double most = std::min(3.0, 0.5 * width);
    if (std::abs(way[0]) > most) end[v] = draft.rest()[v] + (most / std::abs(way[0])) * way;
  }
  draft.frames.push_back(std::move(end));
  return draft;
}

Draft bundle_of_tubes(Random& random, int triangles) {
  constexpr int around = 8, along = 24;
  constexpr double radius = 1.3, gap = 0.3;
  const int of_a_tube = 2 * around * (along - 1) + 2 * around;
  const int tubes = std::max(2, (triangles + of_a_tube / 2) / of_a_tube);
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(tubes))));
  const double squeeze = 0.75 + 0.1 * random.unit(), twist = 0.01 * random.signed_unit();
  Draft draft;
  draft.frames.emplace_back();
  for (int tube = 0; tube < tubes; ++tube) {
    const Point middle = {(2 * radius + gap) * (tube % side), (2 * radius + gap) * (tube / side),
                          0};
    const auto first = draft.vertices();
    for (int i = 0; i < along; ++i) {
      for (int k = 0; k < around; ++k) {
        const double turn = (k + 0.5 * (i % 2)) / around;
        draft.vertex(middle + Point{radius * cos_turn(turn), radius * sin_turn(turn), 1. * i});
      }
    }
    const auto at_ring = [&](int i, int k) { return first + i * around + k % around; };
    for (int i = 0; i + 1 < along; ++i) {
      for (int k = 0; k < around; ++k)
        draft.quad(at_ring(i, k), at_ring(i, k + 1), at_ring(i + 1, k + 1), at_ring(i + 1, k));
    }
    for (const int ring : {0, along - 1}) {
      const auto cap = draft.vertex(middle + Point{0, 0, 1. * ring});
      for (int k = 0; k < around; ++k) {
        const auto a = at_ring(ring, k), b = at_ring(ring, k + 1);
        draft.faces.push_back(ring == 0 ? Face{cap, b, a} : Face{cap, a, b});
      }
    }
  }
  // Each tube comes nearer to the one beside it, and leans.
  Points end;
  const int of_tube = around * along + 2;
  std::vector<Point> leans;
  for (int tube = 0; tube < tubes; ++tube) leans.push_back(any_point(random, 0.04));
  for (std::size_t v = 0; v < draft.rest().size(); ++v) {
    const Point& x = draft.rest()[v];
    const int tube = static_cast<int>(v) / of_tube;
    const double shift = (1 - squeeze) * (tube % side % 2 == 0 ? 1 : -1);
    const Point& lean = leans[static_cast<std::size_t>(tube)];
    const Point noise = any_point(random, 0.1);
    end.push_back(x + Point{2 * radius * shift + x[2] * lean[0], x[2] * (lean[1] + twist), 0} +
                  noise);
  }
  draft.frames.push_back(std::move(end));
  return draft;
}

Draft soup_of_bodies(Random& random, int triangles) {
  constexpr double pitch = 2, size = 0.45, way = 1.6;
  const int bodies = triangles / 4;
  const CubicGrid grid(bodies, pitch);
  Draft draft;
  draft.frames.emplace_back();
  Points end;
  for (int body = 0; body < bodies; ++body) {
    const Point cell = grid.cell(body);
    const auto first = draft.vertices();
    const Point aside = any_point(random, 0.1);
    const Point tilt = any_point(random, 0.4);
    add_tetrahedron(draft, cell + aside, size, tilt);
    const Point by = any_point(random, way);
    for (auto v = first; v < draft.vertices(); ++v) {
      const Point noise = any_point(random, 0.1);
      end.push_back(at(draft.rest(), v) + by + noise);
    }
  }
  draft.frames.push_back(std::move(end));
  return draft;
}

Draft stacks_in_one_place(Random& random, int triangles) {
  // n triangles in stacks of g have n g / 2 pairs of which no box parts two. At n = 1,000 these are
  // 250,000, and they grow with the root of the size.
  const double n = triangles;
  const int stack = std::clamp(static_cast<int>(16'000 / std::sqrt(n)), 8, triangles / 2);
  constexpr double layer = 0x1p-12;
  const double third = std::sqrt(1. / 3);
  Draft draft;
  draft.frames.emplace_back();
  Points end;
  const int stacks = triangles / stack;
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(stacks))));
  for (int s = 0; s < stacks; ++s) {
    const Point place = {3. * (s % side), 3. * (s / side), 0};
    for (int t = 0; t < stack; ++t) {
      // Along the normal of a plane that no axis is near.
      const double along = layer * t;
      const double moved = along + layer * 1.5 * random.signed_unit();
      const auto v = draft.vertices();
      for (const Point& corner : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}) {
        const Point at_rest = place + corner;
        const Point normal = {third, third, third};
        draft.vertex(at_rest + along * normal);
        const double noise = 0.25 * layer * random.signed_unit();
        end.push_back(at_rest + (moved + noise) * normal);
      }
      draft.faces.push_back({v, v + 1, v + 2});
    }
  }
  draft.frames.push_back(std::move(end));
  return draft;
}

}  // namespace assay::properties
