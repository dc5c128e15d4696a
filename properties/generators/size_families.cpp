// Families of large cases, each family of one size. The shape alternates with the index of the
// case, so that a few cases show all shapes.
//
// A shape fills an empty draft with about `triangles` triangles, at least 100, and states the
// places of the vertices at the end of its one motion. Lengths of edges are of the order of 1,
// unless a shape says otherwise. Each shape starts without contact, so that its cases satisfy any
// contract about the start.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "corpus/scenes/shapes.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

using corpus::add_sheet;
using corpus::cos_turn;
using corpus::CubicGrid;
using corpus::nearest_resolution;
using corpus::sin_turn;

// The parts of the shapes, beside the sheets and grids of corpus/scenes/shapes.h.

// Adds a tetrahedron whose corners are `size` from `middle` along each axis, before it is tilted.
void add_tetrahedron(Draft& draft, const Point& middle, double size, const Point& tilt) {
  const Point corners[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const auto v = draft.vertices();
  for (const auto& c : corners) draft.vertex(middle + size * (c + cross(tilt, c)));
  for (const Face& f : {Face{0, 1, 2}, Face{0, 3, 1}, Face{0, 2, 3}, Face{1, 3, 2}})
    draft.faces.push_back({v + f[0], v + f[1], v + f[2]});
}

// Many contacts, which fill buffers, or many boxes that meet. Their number for each triangle does
// not grow with the size, so that the oracle judges a case in seconds.

// Makes sheets that bulge through each other.
void layered_cloth(Random& random, int triangles, Draft& draft, Points& end) {
  constexpr double gap = 0.5;
  constexpr int layers = 8;
  const int cells = nearest_resolution(triangles / layers, 2, [](int k) { return 2 * k * k; });
  for (int layer = 0; layer < layers; ++layer) {
    const double phase = random.unit(), wave = 0.05 + 0.05 * random.unit(),
                 height = 0.8 + random.unit();
    const Point slide = any_vector(random);
    const auto first = draft.vertices();
    add_sheet(draft, {cells, cells}, [&](int k, int i) {
      return Point{static_cast<double>(k), static_cast<double>(i), gap * layer};
    });
    for (auto v = first; v < draft.vertices(); ++v) {
      Point x = at(draft.rest(), v);
      const double bulge = sin_turn(wave * x[0] + phase) * sin_turn(wave * x[1]);
      const Point noise = 0.2 * any_vector(random);
      end.push_back(x + Point{slide[0], slide[1], height * bulge} + noise);
    }
  }
}

// Makes one sheet in pleats, pressed together.
void crumpled_sheet(Random& random, int triangles, Draft& draft, Points& end) {
  constexpr int wall = 8;  // cells from fold to fold
  constexpr double gap = 1;
  const int cells = nearest_resolution(triangles, 2 * wall, [](int k) { return 2 * k * k; });
  const double press = 0.25 + 0.2 * random.unit(), rough = 0.4 + 0.4 * random.unit();
  // Walls that stand upright side by side, joined by their lower and upper edges in turn.
  add_sheet(draft, {cells, cells}, [&](int k, int i) {
    const int period = wall + 1, pleat = k / period, along = k % period;
    const double height = pleat % 2 == 0 ? along : wall - along;
    return Point{gap * pleat, static_cast<double>(i), height};
  });
  for (const auto& x : draft.rest()) {
    const Point noise = rough * any_vector(random);
    const double wave = sin_turn(0.03 * x[1] + 0.1 * x[2]);
    end.push_back(Point{press * x[0] + wave, x[1], 0.9 * x[2]} + noise);
  }
  // The end is moved to where the sheet starts, so that no triangle sweeps far.
  const Point back = mean(draft.rest()) - mean(end);
  for (auto& x : end) x = x + back;
  const double width = gap * cells / (wall + 1);
  for (std::size_t v = 0; v < end.size(); ++v) {
    // A vertex that would sweep over more than a few walls stays nearer.
    const Point way = end[v] - draft.rest()[v];
    const double most = std::min(3.0, 0.5 * width);
    if (std::abs(way[0]) > most) end[v] = draft.rest()[v] + (most / std::abs(way[0])) * way;
  }
}

// Makes closed tubes side by side, squeezed.
void bundle_of_tubes(Random& random, int triangles, Draft& draft, Points& end) {
  constexpr int around = 8, along = 24;
  constexpr double radius = 1.3, gap = 0.3;
  const int of_a_tube = 2 * around * (along - 1) + 2 * around;
  const int tubes = std::max(2, (triangles + of_a_tube / 2) / of_a_tube);
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(tubes))));
  const double squeeze = 0.75 + 0.1 * random.unit(), twist = 0.01 * random.signed_unit();
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
  const int of_tube = around * along + 2;
  std::vector<Point> leans;
  for (int tube = 0; tube < tubes; ++tube) leans.push_back(0.04 * any_vector(random));
  for (std::size_t v = 0; v < draft.rest().size(); ++v) {
    const Point& x = draft.rest()[v];
    const int tube = static_cast<int>(v) / of_tube;
    const double shift = (1 - squeeze) * (tube % side % 2 == 0 ? 1 : -1);
    const Point& lean = leans[static_cast<std::size_t>(tube)];
    const Point noise = 0.1 * any_vector(random);
    end.push_back(x + Point{2 * radius * shift + x[2] * lean[0], x[2] * (lean[1] + twist), 0} +
                  noise);
  }
}

// Makes tetrahedra that fly into each other.
void soup_of_bodies(Random& random, int triangles, Draft& draft, Points& end) {
  constexpr double pitch = 2, size = 0.45, way = 1.6;
  const int bodies = triangles / 4;
  const CubicGrid grid(bodies, pitch);
  for (int body = 0; body < bodies; ++body) {
    const Point cell = grid.cell(body);
    const auto first = draft.vertices();
    const Point aside = 0.1 * any_vector(random);
    const Point tilt = 0.4 * any_vector(random);
    add_tetrahedron(draft, cell + aside, size, tilt);
    const Point by = way * any_vector(random);
    for (auto v = first; v < draft.vertices(); ++v) {
      const Point noise = 0.1 * any_vector(random);
      end.push_back(at(draft.rest(), v) + by + noise);
    }
  }
}

// Makes stacks of triangles so thin that all of a stack lie in the same place: no tree can separate
// them. A stack is half of the mesh at 1,000 triangles; at larger sizes it is a smaller part of it.
void stacks_in_one_place(Random& random, int triangles, Draft& draft, Points& end) {
  // n triangles in stacks of g have n g / 2 pairs that no box separates. At n = 1,000 these are
  // 250,000, and they grow with the root of the size.
  const double n = triangles;
  const int stack = std::clamp(static_cast<int>(16'000 / std::sqrt(n)), 8, triangles / 2);
  constexpr double layer = 0x1p-12;
  const double third = std::sqrt(1. / 3);
  const int stacks = triangles / stack;
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(stacks))));
  for (int s = 0; s < stacks; ++s) {
    const Point place = {3. * (s % side), 3. * (s / side), 0};
    for (int t = 0; t < stack; ++t) {
      // Along the normal of a plane that no axis is near.
      const double along = layer * t;
      const double position = along + layer * 1.5 * random.signed_unit();
      const auto v = draft.vertices();
      for (const Point& corner : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}) {
        const Point at_rest = place + corner;
        const Point normal = {third, third, third};
        draft.vertex(at_rest + along * normal);
        const double noise = 0.25 * layer * random.signed_unit();
        end.push_back(at_rest + (position + noise) * normal);
      }
      draft.faces.push_back({v, v + 1, v + 2});
    }
  }
}

// Few contacts, at places where they are easily lost.

// Adds a wavy sheet of about so many triangles under `height`, which moves a little.
void add_ground(Draft& draft, Points& end, Random& random, int triangles, double height) {
  const int cells = nearest_resolution(triangles, 1, [](int k) { return 2 * k * k; });
  const double phase = random.unit();
  const auto first = draft.vertices();
  add_sheet(draft, {cells, cells}, [&](int k, int i) {
    return Point{1. * k, 1. * i, height + 0.1 * sin_turn(0.07 * (k + i) + phase)};
  });
  for (auto v = first; v < draft.vertices(); ++v) {
    const Point noise = 0.02 * any_vector(random);
    end.push_back(at(draft.rest(), v) + noise);
  }
}

// Moves the vertices from `first` on.
void move_all(const Draft& draft, Points& end, std::int32_t first, const Point& by) {
  for (auto v = first; v < draft.vertices(); ++v) end.push_back(at(draft.rest(), v) + by);
}

// Makes a sheet, and one body that falls on its far corner: its triangles are the last of the mesh.
void contact_in_a_far_corner(Random& random, int triangles, Draft& draft, Points& end) {
  constexpr double size = 0.3, above = 2;
  add_ground(draft, end, random, triangles - 4, 0);
  const double corner = draft.rest().back()[0];
  const auto first = draft.vertices();
  const double x = corner - 0.5 - random.unit(), y = corner - 0.5 - random.unit();
  const Point tilt = 0.4 * any_vector(random);
  add_tetrahedron(draft, {x, y, above}, size, tilt);
  move_all(draft, end, first, {0, 0, -above * (0.8 + 0.4 * random.unit())});
}

// Makes bodies on a grid. Every fiftieth body meets its neighbour.
void many_components(Random& random, int triangles, Draft& draft, Points& end) {
  constexpr double pitch = 3, size = 0.5;
  constexpr int every = 50;
  const int bodies = triangles / 4;
  const CubicGrid grid(bodies, pitch);
  for (int body = 0; body < bodies; ++body) {
    const Point cell = grid.cell(body);
    const auto first = draft.vertices();
    const Point tilt = 0.4 * any_vector(random);
    add_tetrahedron(draft, cell, size, tilt);
    const bool meets = body % every == every - 1;
    const Point aside = 0.2 * any_vector(random);
    move_all(draft, end, first, aside + Point{meets ? -pitch : 0., 0, 0});
  }
}

// Makes 44 to 60 pairs of bodies that meet, each half as large and half as far from one point as
// the pair before: a tree that halves space becomes as deep. The rest of the mesh is a sheet.
void bodies_to_one_point(Random& random, int triangles, Draft& draft, Points& end) {
  const int pairs = std::min(random.between(44, 60), triangles / 16);
  add_ground(draft, end, random, triangles - 8 * pairs, -4);
  for (int i = 0; i < pairs; ++i) {
    const double scale = std::ldexp(1, -i);
    const Point lower = scale * Point{1, 1, 1}, upper = scale * Point{1, 1, 1.5};
    for (const bool falls : {false, true}) {
      const auto first = draft.vertices();
      const Point tilt = 0.4 * any_vector(random);
      add_tetrahedron(draft, falls ? upper : lower, 0.1 * scale, tilt);
      const Point aside = 0.02 * any_vector(random);
      move_all(draft, end, first, scale * (aside + Point{0, 0, falls ? -0.4 : 0.}));
    }
  }
}

// Makes a vertex of 1,000 triangles, some of which slide through each other; the rest is a sheet.
void vertex_of_high_valence(Random& random, int triangles, Draft& draft, Points& end) {
  const int spokes = std::min(1000, triangles);
  constexpr double radius = 8, height = 3;
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
}

// Makes a closed sphere that breathes, and meets nothing.
void breathing_sphere(Random& random, int triangles, Draft& draft, Points& end) {
  auto mesh = corpus::sphere_shape(triangles);
  // Edges of the order of 1.
  const double radius = std::sqrt(static_cast<double>(triangles)) / 4;
  const double breath = 0.5 + random.unit(), phase = random.unit();
  draft.star_shaped = true;
  for (const auto& x : mesh.positions.rowwise()) {
    const Point p = {radius * x[0], radius * x[1], radius * x[2]};
    draft.vertex(p);
    const double by = breath * (1 + 0.1 * sin_turn(0.5 * x[2] + phase));
    end.push_back(by * p);
  }
  for (const auto& f : mesh.triangles.rowwise()) draft.faces.push_back({f[0], f[1], f[2]});
}

struct LargeShape {
  const char* name;
  void (*make)(Random& random, int triangles, Draft& draft, Points& end);
};

// The sparse ones come first, because a test can afford a few of them.
constexpr LargeShape large_shapes[] = {
    {"far-corner", contact_in_a_far_corner},
    {"cloth", layered_cloth},
    {"to-one-point", bodies_to_one_point},
    {"one-place", stacks_in_one_place},
    {"soup", soup_of_bodies},
    {"valence", vertex_of_high_valence},
    {"crumpled", crumpled_sheet},
    {"components", many_components},
    {"tubes", bundle_of_tubes},
    {"sphere", breathing_sphere},
};

// Returns the index of the id plus the number of the attempt behind it ("quick:1:size-1e4:3~2"). So
// if a contract cannot take a shape, it gets the next shape.
std::size_t turn_of(const std::string& id) {
  char* end = nullptr;
  const auto index = std::strtoull(id.c_str() + id.rfind(':') + 1, &end, 10);
  const auto attempt = *end == '~' ? std::strtoull(end + 1, nullptr, 10) : 0;
  return static_cast<std::size_t>(index + attempt);
}

// Applies one linear map near the identity, so that nothing lies along the axes. It keeps contacts,
// except where rounding decides.
void map_all(Random& random, Draft& draft) {
  Point rows[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (auto& row : rows) {
    for (double& entry : row) entry += 0.2 * random.signed_unit();
  }
  for (auto& frame : draft.frames) {
    for (auto& x : frame) x = {dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)};
  }
}

constexpr int largest_with_two_steps = 2000;

template <int triangles>
RandomCase make_large(Random& random, std::string id) {
  const LargeShape& shape = large_shapes[turn_of(id) % std::size(large_shapes)];
  Draft draft;
  draft.frames.resize(2);
  shape.make(random, triangles, draft, draft.frames[1]);
  // A second step, which goes on in the same direction, shows the state that is carried.
  if (triangles <= largest_with_two_steps) {
    Points beyond;
    for (std::size_t v = 0; v < draft.rest().size(); ++v)
      beyond.push_back(between(draft.frames[0][v], draft.frames[1][v], 1.25));
    draft.frames.push_back(std::move(beyond));
  }
  map_all(random, draft);
  draft.tag(is_cycle(draft.faces) ? "closed" : "unclosed");
  draft.tag(std::string("large:") + shape.name);
  return finished(std::move(draft), std::move(id));
}

constexpr Family size_table[] = {
    {"size-1e3", "1,000 triangles", false, false, make_large<1000>, 1000},
    {"size-1e4", "10,000 triangles", false, false, make_large<10'000>, 10'000},
    {"size-1e5", "100,000 triangles", false, false, make_large<100'000>, 100'000},
    {"size-1e6", "1,000,000 triangles", false, false, make_large<1'000'000>, 1'000'000},
};

}  // namespace

std::span<const Family> size_families() { return size_table; }

bool is_size_family(std::string_view name) {
  return std::ranges::find(size_table, name, &Family::name) != std::end(size_table);
}

}  // namespace assay::properties
