#include <algorithm>
#include <cmath>
#include <limits>

#include "detector/mesh/for_all.h"
#include "properties/changes/changes.h"
#include "properties/generators/draft.h"
#include "properties/generators/parts.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

// Makes the vertices from `first` on a body of their own in the relation. Their places at rest are
// those at the start. Facts about the case without them are dropped.
void tell_of_added(Case& c, std::int32_t first) {
  if (c.counted) {
    auto& [pairs, steps] = *c.counted;
    steps.clear();
    if (!pairs.body.empty()) {
      const auto fresh = *std::ranges::max_element(pairs.body) + 1;
      pairs.body.resize(static_cast<std::size_t>(c.frames.front().rows()), fresh);
    }
    if (!pairs.rest.empty()) {
      const auto at_rest = corpus::points_of(c.frames.front());
      pairs.rest.insert(pairs.rest.end(), at_rest.begin() + first, at_rest.end());
    }
  }
  c.expected = {};
  c.view.reset();
  c.ghosts.reset();
}

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
    Point rotated_point{};
    for (std::size_t k = 0; k < 3; ++k) rotated_point[axis[k]] = sign[k] * x[k];
    return rotated_point;
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
  Approach approach;
  for (std::size_t i = 0; i < 3; ++i) {
    Point a{}, b{};
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = unit * scene.a[i][k];
      b[k] = unit * scene.b[i][k];
    }
    approach.a[i] = {turn(a), turn(a)};
    Point b_t0 = b, b_t1 = b;
    const auto up = static_cast<std::size_t>(scene.up);
    const auto along = static_cast<std::size_t>(scene.along);
    b_t0[up] += heights.t0;
    b_t1[up] += heights.t1;
    b_t0[along] += heights.along_t0;
    b_t1[along] += heights.along_t1;
    approach.b[i] = {turn(b_t0), turn(b_t1)};
  }
  return approach;
}

Case with_approach(Case c, double d, Random& random) {
  const Approach approach = draw_approach(random, d);
  const auto& [a, b] = approach;
  if (const auto query = query_of(c)) {
    FourPoints aimed = *query;
    aimed.points = query->first_group == 1 ? std::array{b[0], a[0], a[1], a[2]}
                                           : std::array{a[0], a[1], b[0], b[1]};
    return case_of_query(aimed, c.id);
  }
  const auto steps = steps_of(c);
  const auto& step = one_of(random, steps);
  double largest = greatest_of(c);
  for (const auto* triangle : {&a, &b}) {
    for (const MovingPoint& p : *triangle) {
      for (std::size_t k = 0; k < 3; ++k)
        largest = std::max({largest, std::abs(p.t0[k]), std::abs(p.t1[k])});
    }
  }
  if (largest > most_aimed) return c;
  // The mesh moves, because the numbers of the approach have to stay exact.
  const double away = std::ldexp(1.0, std::ilogb(largest) + 6);
  const auto vertices = static_cast<std::int32_t>(c.frames.front().rows());
  for (auto& frame : c.frames) frame.array() += away;
  const Triangles two{{0, 1, 2}, {3, 4, 5}};
  add_mesh(c, two, [&](std::size_t f) {
    const bool has_moved = static_cast<std::int32_t>(f) >= step.to;
    Points x;
    for (const auto& triangle : {a, b}) {
      for (const auto& [t0, t1] : triangle) x.push_back(has_moved ? t1 : t0);
    }
    return as_rows<Positions>(x);
  });
  tell_of_added(c, vertices);
  return c;
}

namespace {

constexpr std::int32_t side = 112;  // vertices along each side of the sheet
static_assert(std::size_t{side} * side > 3 * detector::least_shared);

Triangles triangles_of_sheet() {
  Triangles triangles(Eigen::Index{2} * (side - 1) * (side - 1), 3);
  Eigen::Index t = 0;
  for (std::int32_t i = 0; i + 1 < side; ++i) {
    for (std::int32_t j = 0; j + 1 < side; ++j) {
      const auto a = side * i + j, b = a + side;
      triangles.row(t++) << a, b, b + 1;
      triangles.row(t++) << a, b + 1, a + 1;
    }
  }
  return triangles;
}

}  // namespace

std::optional<Case> with_far_body(Case c, double apart) {
  const double largest = greatest_of(c);
  constexpr double most = 0x1p900;
  if (!(largest > 1 / most && largest < most && apart < most)) return std::nullopt;
  Random random(Random::hash(c.id), Random::hash("far body"));
  // All places of the grid are small integers times a power of two, the width of a cell.
  const int reach = std::ilogb(largest) + 1, finest = reach - random.between(0, 16);
  const double cell = std::ldexp(1, apart > 0 ? std::max(finest, std::ilogb(apart) + 2) : finest);
  const double start = cell * (std::ceil(std::ldexp(4, reach) / cell) + 4);
  const auto vertices = static_cast<std::int32_t>(c.frames.front().rows());
  add_mesh(c, triangles_of_sheet(), [&](std::size_t) {
    const double height = random.signed_unit();
    Positions x(side * side, 3);
    for (std::int32_t i = 0; i < side; ++i) {
      for (std::int32_t j = 0; j < side; ++j) {
        const double u = i - side / 2, v = j - side / 2;
        x.row(side * i + j) << start + cell * i, cell * v, cell * (height + (u * u + v * v) / side);
      }
    }
    return x;
  });
  tell_of_added(c, vertices);
  return c;
}

}  // namespace assay::properties
