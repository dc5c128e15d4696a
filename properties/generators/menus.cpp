#include "properties/generators/menus.h"

#include <cmath>
#include <limits>

namespace assay::properties {
namespace {

constexpr int least_exponent = -1074;

// Calls change(point) for every vertex of every frame and for the view primitive.
template <class Change>
void for_each_point(Draft& draft, const Change& change) {
  for (auto& x : draft.frames) {
    for (auto& p : x) change(p);
  }
  for (auto& p : draft.q0) change(p);
  for (auto& p : draft.q1) change(p);
}

}  // namespace

void round_to_grid(Draft& draft, double scale, int bits) {
  const double unit = std::ldexp(1, bits);
  for_each_point(draft, [=](Point& p) {
    // Adding 0.0 turns -0 into 0, because -0 is written differently.
    for (double& c : p) c = std::floor(c * scale * unit + 0.5) / unit + 0.0;
  });
}

void place_ulp_neighbours(Random& random, Draft& draft) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (int changes = random.between(1, 6); changes > 0; --changes) {
    Points& x = any_of(random, draft.frames);
    const Point other = any_of(random, x);
    Point& p = any_of(random, x);
    const auto k = at(random.below(3));
    // Mostly the coordinate stays near its own value. The value of another vertex moves the vertex
    // far.
    double c = random.one_in(4) ? other[k] : p[k];
    const double towards = random.one_in(2) ? infinity : -infinity;
    for (int i = random.between(1, 3); i > 0; --i) {
      c = c == 0 ? std::copysign(std::numeric_limits<double>::epsilon(), towards)
                 : std::nextafter(c, towards);
    }
    p[k] = c;
  }
  draft.tag("menu:ulp");
}

void move_far(Random& random, Draft& draft) {
  Point offset;
  for (double& c : offset) {
    const double sign = random.one_in(2) ? 1 : -1;
    const double large = std::ldexp(sign, random.between(8, 40));
    c = large + random.below(1000);
  }
  for_each_point(draft, [&](Point& p) { p = p + offset; });
  draft.tag("menu:far");
}

void mix_scales(Random& random, Draft& draft) {
  const int reach = random.one_in(16) ? 400 : 60;
  const auto exponent = [&] { return random.between(-reach, reach); };
  const int kind = random.below(3);
  if (kind == 0) {
    const int e = exponent();
    for_each_point(draft, [=](Point& p) {
      for (double& c : p) c = std::ldexp(c, e);
    });
  } else if (kind == 1) {
    const std::array<int, 3> e = {exponent(), exponent(), exponent()};
    for_each_point(draft, [=](Point& p) {
      for (std::size_t k = 0; k < 3; ++k) p[k] = std::ldexp(p[k], e[k]);
    });
  } else {
    for (std::int32_t v = 0; v < draft.vertices(); ++v) {
      const int divisor = random.one_in(4) ? 1 : 20;
      const int e = exponent() / divisor;
      for (auto& x : draft.frames) {
        for (double& c : at(x, v)) c = std::ldexp(c, e);
      }
    }
  }
  draft.tag(reach == 60 ? "menu:mixed-scales" : "menu:wide-scales");
}

void make_denormal(Random& random, Draft& draft) {
  // Exact numbers with 1074 bits below the point, beside ordinary numbers, are what an oracle is
  // slowest at. So only small meshes get them.
  constexpr std::size_t most_faces_among_others = 40;
  if (random.one_in(2) || draft.faces.size() > most_faces_among_others) {
    // A coarse grid on a large mesh makes thousands of degenerate contacts, so a large mesh gets a
    // fine one.
    const int least = draft.faces.size() > most_faces_among_others ? 12 : 1;
    round_to_grid(draft, std::ldexp(1, random.between(least, 20)), 0);
    for_each_point(draft, [](Point& p) {
      for (double& c : p) c = std::ldexp(c, least_exponent);
    });
  } else {
    for (int changes = random.between(1, 8); changes > 0; --changes) {
      Point& p = any_of(random, any_of(random, draft.frames));
      p[at(random.below(3))] = std::ldexp(random.between(-3, 3), least_exponent) + 0.0;
    }
  }
  draft.tag("menu:denormal");
}

}  // namespace assay::properties
