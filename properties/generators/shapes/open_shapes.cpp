#include <algorithm>

#include "corpus/scenes/shapes.h"
#include "properties/generators/parts.h"
#include "properties/random.h"

namespace assay::properties {

namespace {

using corpus::cos_turn;
using corpus::sin_turn;

// Cuts away all triangles around a vertex, or one triangle. At least one triangle stays.
void cut_hole(Random& random, Draft& d) {
  const Face face = one_of(random, d.faces);
  const std::int32_t v = face[0];
  const auto around = std::ranges::count_if(d.faces, [v](const Face& f) { return has(f, v); });
  const bool whole_star =
      random.below(2) == 0 && around * 2 <= static_cast<std::ptrdiff_t>(d.faces.size());
  if (whole_star) {
    d.holes.push_back(at(d.rest(), v));
    std::erase_if(d.faces, [v](const Face& f) { return has(f, v); });
  } else if (d.faces.size() > 1) {
    d.holes.push_back(mean({at(d.rest(), face[0]), at(d.rest(), face[1]), at(d.rest(), face[2])}));
    std::erase(d.faces, face);
  }
}

Draft with_holes(Random& random, Draft d) {
  const int most = d.faces.size() < 8 ? 1 : d.faces.size() < 20 ? 2 : 4;
  const int holes = random.between(1, most);
  for (int i = 0; i < holes; ++i) cut_hole(random, d);
  // Two holes can take a small piece away as a whole, so that a closed one is left. Then one
  // triangle is removed from it.
  if (is_cycle(d.faces)) d.faces.pop_back();
  drop_unused_vertices(d);
  d.tag("holes:" + std::to_string(holes));
  return d;
}

// Makes rows x columns of quads. `place` puts (i,j) into space.
template <class Place>
Draft grid(int rows, int columns, bool around, const Place& place) {
  Draft d;
  d.frames.emplace_back();
  const int across = around ? columns : columns + 1;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j < across; ++j) d.vertex(place(i, j));
  }
  const auto number = [=](int i, int j) { return i * across + j % across; };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      d.quad(number(i, j), number(i, j + 1), number(i + 1, j + 1), number(i + 1, j));
    }
  }
  return d;
}

// Chooses {rows, columns} so that 2 rows columns is about size.
std::array<int, 2> shape_of_grid(int size, int least_columns) {
  int columns = least_columns;
  while (2 * (columns + 1) * (columns + 1) <= size) ++columns;
  return {std::max(1, size / (2 * columns)), columns};
}

Draft sheet(Random& random, int size) {
  const auto [rows, columns] = shape_of_grid(size, 1);
  const double wave = random.below(2) == 0 ? 0 : random.unit();
  Draft d = grid(rows, columns, false, [&, r = rows, c = columns](int i, int j) -> Point {
    const double x = 2.0 * j / c - 1, y = 2.0 * i / r - 1;
    return {x, y, wave * x * y + 0.25 * wave * random.signed_unit() / (r + c)};
  });
  d.axis = {{{-1, 0, -1}, {1, 0, -1}}};
  d.tag("shape:sheet");
  d.holes.push_back({0, 0, 0});
  return d;
}

Draft tube(Random& random, int size) {
  const int sides = size < 40 ? 3 : random.between(3, 6);
  const int rows = std::max(1, size / (2 * sides));
  const double half = 1 + random.unit();
  Draft d = grid(rows, sides, true, [=, r = rows](int i, int j) -> Point {
    const double turn = static_cast<double>(j) / sides;
    return {0.5 * cos_turn(turn), 0.5 * sin_turn(turn), half * (2.0 * i / r - 1)};
  });
  d.holes = {{0, 0, -half}, {0, 0, half}};
  d.axis = {{{0, 0, -half / 2}, {0, 0, half / 2}}};
  d.star_shaped = true;
  d.tag("shape:tube");
  d.tag("holes:2");
  return d;
}

// Returns a ribbon around the z axis that goes outward, and so lies over itself after one turn.
Draft spiral(Random& random, int size) {
  const int columns = std::max(5, size / 2);
  const double turns = 1.125 + random.unit();
  const double growth = 0.25 + 0.5 * random.unit();
  Draft d = grid(1, columns, false, [=](int i, int j) -> Point {
    const double turn = turns * j / columns, r = 0.5 + growth * turn;
    return {r * cos_turn(turn), r * sin_turn(turn), i - 0.5};
  });
  d.star_shaped = true;  // positive all along, though it lies over itself (case of L9)
  d.holes.push_back({0.5 + growth * 0.5, 0, 0});
  d.tag("shape:spiral");
  return d;
}

// Returns a ring with a gap, which closes when all vertices go their way (Draft::closing): a flat
// one, a tube with an open seam, or a sheet that curls onto its own border. Its two ends then meet,
// only just miss each other, or pass. A ramp takes some ends past each other.
Draft open_ring(Random& random, int size) {
  const int rows = random.between(1, size < 24 ? 1 : 3), along = std::max(6, size / (2 * rows));
  const bool flat = random.one_in(2);
  const double width = 0.25 + 0.5 * random.unit();
  const double ramp = random.one_in(2) ? 0 : 0.25 * random.signed_unit();
  const double gap = random.one_in(3) ? 0.5 : 0.25 * (0.125 + random.unit());
  constexpr std::array over = {0.0, 0.0, 0x1p-30, -0x1p-30, 0x1p-8, -0x1p-8, 0x1p-4};
  const double full_turn = 1 + one_of(random, over);
  // A rolled sheet keeps the length of its columns.
  const auto place = [=](int i, int j, double turns) -> Point {
    const double share = 2.0 * j / along - 1, turn = turns * share / 2;
    const double radius = flat ? 1 + width * i / rows : 1 / turns;
    const double height = (flat ? 0.0 : width * (2.0 * i / rows - 1)) + ramp * share;
    return {radius * cos_turn(turn), radius * sin_turn(turn), height};
  };
  Draft d = grid(rows, along, false, [&](int i, int j) { return place(i, j, 1 - gap); });
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= along; ++j)
      d.closing.push_back(place(i, j, full_turn) - place(i, j, 1 - gap));
  }
  d.holes.push_back({0, 0, 0});
  d.tag(flat ? "shape:flat-ring" : "shape:rolled-ring");
  return d;
}

// Returns two holes of one triangle each that meet at a vertex only. The loop passes that vertex
// twice.
Draft loop_twice_through_a_vertex(Random& random, int size) {
  Draft d = star_shape(random, std::max(size, 8));
  const Face first = one_of(random, d.faces);
  const std::int32_t v = first[0];
  for (const auto& f : d.faces) {
    const auto shared = std::ranges::count_if(f, [&](auto w) { return has(first, w); });
    if (!has(f, v) || shared != 1) continue;
    const Face second = f;
    std::erase(d.faces, first);
    std::erase(d.faces, second);
    d.holes = {at(d.rest(), first[1]), at(d.rest(), second[1])};
    d.tag("holes:vertex-twice");
    return d;
  }
  return with_holes(random, std::move(d));
}

Draft cut_open(Random& random, int size) {
  return with_holes(random, closed_shape(random, std::max(size, 6)));
}

}  // namespace

Draft open_star_shape(Random& random, int size) {
  return with_holes(random, star_shape(random, std::max(size, 6)));
}

Draft open_shape(Random& random, int size) {
  // A shape that stands here twice is made twice as often.
  constexpr Draft (*shapes[])(Random&, int) = {
      sheet,           open_ring,       tube,     spiral,  loop_twice_through_a_vertex,
      open_star_shape, open_star_shape, cut_open, cut_open};
  return one_of(random, shapes)(random, size);
}

namespace {

std::int32_t any_vertex(Random& random, const Draft& d) { return random.below(d.vertices()); }

void lose_faces(Random& random, Draft& d) {
  for (int n = random.between(1, 3); n > 0 && d.faces.size() > 1; --n) {
    d.faces.erase(d.faces.begin() + random.below(static_cast<int>(d.faces.size())));
  }
}

void turn_faces(Random& random, Draft& d) {
  for (int n = random.between(1, 3); n > 0; --n) {
    Face& f = one_of(random, d.faces);
    std::swap(f[1], f[2]);
  }
}

// Puts three to six triangles at one edge, fanned outward.
void add_leaves(Random& random, Draft& d) {
  const Face f = one_of(random, d.faces);
  for (int n = random.between(1, 4); n > 0; --n) {
    const double away = random.between(5, 8) / 4.0, along = random.between(0, 4) / 4.0;
    const Point aside = {random.signed_unit() / 4, random.signed_unit() / 4, 0};
    const Point out = away * between(at(d.rest(), f[0]), at(d.rest(), f[1]), along) + aside;
    const auto leaf = d.vertex(out);
    if (random.one_in(2)) {
      d.faces.push_back({f[0], f[1], leaf});
    } else {
      d.faces.push_back({f[1], f[0], leaf});
    }
  }
}

// Adds triangles that have no area at the start. Their third corner is the middle of the other
// two, or one of them once more.
void add_zero_area(Random& random, Draft& d) {
  const Face f = one_of(random, d.faces);
  const Point &a = at(d.rest(), f[0]), &b = at(d.rest(), f[1]);
  const auto third = d.vertex(between(a, b, random.one_in(2) ? 0.5 : random.between(0, 6) / 2.0));
  d.faces.push_back({f[0], f[1], third});
}

// Gives some triangles around a vertex a copy of it. This makes a seam, which opens when the copies
// part.
void open_seam(Random& random, Draft& d) {
  const std::int32_t v = one_of(random, d.faces)[0];
  const auto copy = d.vertex(at(d.rest(), v));
  for (auto& f : d.faces) {
    for (auto& w : f) {
      if (w == v && random.one_in(2)) w = copy;
    }
  }
}

void double_a_vertex(Random& random, Draft& d) {
  at(d.rest(), any_vertex(random, d)) = at(d.rest(), any_vertex(random, d));
}

void add_unused_vertices(Random& random, Draft& d) {
  for (int n = random.between(1, 3); n > 0; --n) {
    d.vertex(any_vector(random));
  }
}

void add_any_faces(Random& random, Draft& d) {
  for (int n = random.between(1, 3); n > 0; --n) {
    d.faces.push_back({any_vertex(random, d), any_vertex(random, d), any_vertex(random, d)});
  }
}

struct Damage {
  const char* name;
  void (*apply)(Random&, Draft&);
};
constexpr Damage damages[] = {
    {"missing-faces", lose_faces},
    {"turned-faces", turn_faces},
    {"leaves", add_leaves},
    {"zero-area", add_zero_area},
    {"open-seam", open_seam},
    {"doubled-vertex", double_a_vertex},
    {"unused-vertices", add_unused_vertices},
    {"any-faces", add_any_faces},
};

}  // namespace

Draft broken_shape(Random& random, int size) {
  Draft d = random.one_in(3) ? open_shape(random, size) : closed_shape(random, size);
  for (int n = random.between(1, 3); n > 0; --n) {
    const Damage& damage = one_of(random, damages);
    damage.apply(random, d);
    d.tag(std::string("broken:") + damage.name);
    // Invalid faces are dropped at once, because a later damage may cut away all faces but one,
    // and that one must not be an invalid face.
    drop_invalid_faces(d);
  }
  return d;
}

}  // namespace assay::properties
