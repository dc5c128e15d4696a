#include "properties/generators/shapes/broken_shapes.h"

#include <algorithm>

#include "properties/generators/shapes/closed_shapes.h"
#include "properties/generators/shapes/open_shapes.h"

namespace assay::properties {
namespace {

std::int32_t any_vertex(Random& random, const Draft& d) { return random.below(d.vertices()); }

void lose_faces(Random& random, Draft& d) {
  for (int n = random.between(1, 3); n > 0 && d.faces.size() > 1; --n) {
    d.faces.erase(d.faces.begin() + random.below(static_cast<int>(d.faces.size())));
  }
}

void turn_faces(Random& random, Draft& d) {
  for (int n = random.between(1, 3); n > 0; --n) {
    Face& f = any_of(random, d.faces);
    std::swap(f[1], f[2]);
  }
}

// Puts three to six triangles at one edge, fanned outward.
void add_leaves(Random& random, Draft& d) {
  const Face f = any_of(random, d.faces);
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
  const Face f = any_of(random, d.faces);
  const Point &a = at(d.rest(), f[0]), &b = at(d.rest(), f[1]);
  const auto third = d.vertex(between(a, b, random.one_in(2) ? 0.5 : random.between(0, 6) / 2.0));
  d.faces.push_back({f[0], f[1], third});
}

// Some triangles around a vertex take a copy of it. This makes a seam, which opens when the copies
// part.
void open_seam(Random& random, Draft& d) {
  const std::int32_t v = any_of(random, d.faces)[0];
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
    d.vertex({random.signed_unit(), random.signed_unit(), random.signed_unit()});
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
    const Damage& damage = any_of(random, damages);
    damage.apply(random, d);
    d.tag(std::string("broken:") + damage.name);
    // Invalid faces are dropped at once, because a later damage may cut away all faces but one,
    // and that one must not be an invalid face.
    drop_invalid_faces(d);
  }
  return d;
}

}  // namespace assay::properties
