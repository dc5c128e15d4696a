#include "properties/generators/approaches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

using detector::MovingPoint;
using detector::Point;

using Corners = std::array<std::array<int, 3>, 3>;

// Two triangles that meet in their nearest features, in units of some power of two. Moved apart
// along the axis `up` by h, b is at the distance h from a. It stays so when b moves along the axis
// `along`, by up to one unit; if `passes`, the distance is h only where b is not moved.
struct Scene {
  Corners a, b;
  int up, along;
  bool passes;
};

constexpr Scene scenes[] = {
    // a vertex over a face
    {{{{-4, -4, 0}, {4, -4, 0}, {0, 4, 0}}}, {{{0, -1, 0}, {1, -1, 4}, {-1, 0, 4}}}, 2, 0, false},
    // two edges that cross
    {{{{-4, 0, 0}, {4, 0, 0}, {0, -1, -4}}}, {{{0, -4, 0}, {0, 4, 0}, {1, 0, 4}}}, 2, 0, false},
    // a vertex beside an edge
    {{{{-4, 0, 0}, {4, 0, 0}, {0, -4, 0}}}, {{{0, 0, 0}, {1, 4, 1}, {-1, 4, 1}}}, 1, 2, true},
    // two vertices
    {{{{0, 0, 0}, {-4, 2, 0}, {-4, -2, 1}}}, {{{0, 0, 0}, {4, 2, 1}, {4, -2, 0}}}, 0, 1, true},
    // two parallel edges
    {{{{-4, 0, 0}, {4, 0, 0}, {0, -4, -1}}}, {{{-2, 0, 0}, {3, 0, 0}, {0, 4, 1}}}, 1, 2, true},
};

// How far apart the two are at t=0 and at t=1, and where b is along its other axis.
struct Heights {
  double t0, t1;
  double along_t0 = 0, along_t1 = 0;
};

Heights draw_heights(Random& random, const Scene& scene, double d, double unit) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double before = std::nextafter(d, 0.0), after = std::nextafter(d, infinity);
  const std::array nearby = {d, before, after, d - d * 0x1p-20, d / 2};
  const double near = nearby[static_cast<std::size_t>(random.below(5))];
  switch (random.below(4)) {
    case 0:  // begins at d, or only just outside, and goes away
      return {random.one_in(4) ? d : after, d + unit};
    case 1:
      if (scene.passes) return {near, near, -2 * unit, 2 * unit};
      return {after, after, -unit, unit};  // stays only just outside
    default:
      return {d + unit, near};
  }
}

// The axes in another order and direction.
struct Turn {
  std::array<std::size_t, 3> axis;
  std::array<double, 3> sign;

  Point operator()(const Point& x) const {
    Point turned{};
    for (std::size_t k = 0; k < 3; ++k) turned[axis[k]] = sign[k] * x[k];
    return turned;
  }
};

Turn draw_turn(Random& random) {
  const auto first = static_cast<std::size_t>(random.below(3));
  const std::size_t step = random.one_in(2) ? 1 : 2;
  Turn turn{{first, (first + step) % 3, (first + 2 * step) % 3}, {}};
  for (double& s : turn.sign) s = random.one_in(2) ? 1 : -1;
  return turn;
}

}  // namespace

Approach draw_approach(Random& random, double d) {
  const Scene& scene = scenes[random.below(static_cast<int>(std::size(scenes)))];
  const double unit = std::ldexp(1.0, std::ilogb(d) + random.between(2, 6));
  const Heights heights = draw_heights(random, scene, d, unit);
  const Turn turn = draw_turn(random);
  Approach made;
  for (std::size_t i = 0; i < 3; ++i) {
    Point a{}, b{};
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = unit * scene.a[i][k];
      b[k] = unit * scene.b[i][k];
    }
    made.a[i] = {turn(a), turn(a)};
    Point b_t0 = b, b_t1 = b;
    const auto up = static_cast<std::size_t>(scene.up);
    const auto along = static_cast<std::size_t>(scene.along);
    b_t0[up] += heights.t0;
    b_t1[up] += heights.t1;
    b_t0[along] += heights.along_t0;
    b_t1[along] += heights.along_t1;
    made.b[i] = {turn(b_t0), turn(b_t1)};
  }
  return made;
}

corpus::Case with_approach(corpus::Case c, double d, Random& random) {
  const Approach approach = draw_approach(random, d);
  const auto& [a, b] = approach;
  if (const auto query = query_of(c)) {
    detector::FourPoints aimed = *query;
    aimed.points = query->first_group == 1 ? std::array{b[0], a[0], a[1], a[2]}
                                           : std::array{a[0], a[1], b[0], b[1]};
    return case_of_query(aimed, c.id);
  }
  const auto steps = corpus::steps_of(c);
  const auto& step = steps[static_cast<std::size_t>(random.below(static_cast<int>(steps.size())))];
  double largest = 0;
  for (const auto* triangle : {&a, &b}) {
    for (const MovingPoint& p : *triangle) {
      for (std::size_t k = 0; k < 3; ++k)
        largest = std::max({largest, std::abs(p.t0[k]), std::abs(p.t1[k])});
    }
  }
  for (const auto& frame : c.frames) {
    if (frame.size() > 0) largest = std::max(largest, frame.cwiseAbs().maxCoeff());
  }
  if (largest > most_aimed) return c;
  // The mesh moves, because the numbers of the approach have to stay exact.
  const double away = std::ldexp(1.0, std::ilogb(largest) + 6);
  const auto vertices = static_cast<std::int32_t>(c.frames.front().rows());
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    auto& frame = c.frames[f];
    frame.conservativeResize(vertices + 6, 3);
    const bool has_moved = static_cast<std::int32_t>(f) >= step.to;
    for (int i = 0; i < 6; ++i) {
      const MovingPoint& point =
          i < 3 ? a[static_cast<std::size_t>(i)] : b[static_cast<std::size_t>(i - 3)];
      const Point& x = has_moved ? point.t1 : point.t0;
      for (int k = 0; k < 3; ++k) frame(vertices + i, k) = x[static_cast<std::size_t>(k)];
    }
  }
  if (c.counted) {
    // The two are a body of their own. At rest they are as at the start.
    auto& [pairs, expected_steps] = *c.counted;
    expected_steps.clear();
    if (!pairs.body.empty()) {
      const auto fresh = *std::max_element(pairs.body.begin(), pairs.body.end()) + 1;
      pairs.body.insert(pairs.body.end(), 6, fresh);
    }
    for (int i = 0; i < 6 && !pairs.rest.empty(); ++i) {
      const auto row = c.frames.front().row(vertices + i);
      pairs.rest.push_back({row[0], row[1], row[2]});
    }
  }
  for (auto& frame : c.frames) frame.topRows(vertices).array() += away;
  const Eigen::Index triangles = c.triangles.rows();
  c.triangles.conservativeResize(triangles + 2, 3);
  c.triangles.row(triangles) << vertices, vertices + 1, vertices + 2;
  c.triangles.row(triangles + 1) << vertices + 3, vertices + 4, vertices + 5;
  c.expected = {};
  c.view.reset();
  c.ghosts.reset();
  return c;
}

}  // namespace assay::properties
