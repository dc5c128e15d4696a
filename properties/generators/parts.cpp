#include "properties/generators/parts.h"

#include <algorithm>
#include <cmath>

#include "detector/mesh/topology.h"
#include "properties/random.h"

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

// Gives some vertices a coordinate that lies beside another vertex's, by 1 to 3 units of the last
// place.
void place_ulp_neighbours(Random& random, Draft& draft) {
  for (int changes = random.between(1, 6); changes > 0; --changes) {
    Points& x = one_of(random, draft.frames);
    const Point other = one_of(random, x);
    Point& p = one_of(random, x);
    const auto k = at(random.below(3));
    // Mostly the coordinate stays near its own value. The value of another vertex moves the vertex
    // far.
    const double c = random.one_in(4) ? other[k] : p[k];
    const double towards = random.one_in(2) ? 1 : -1;
    p[k] = units_beyond(c, random.between(1, 3), towards);
  }
  draft.tag("menu:ulp");
}

}  // namespace

void round_to_grid(Draft& draft, double scale, int bits) {
  const double unit = std::ldexp(1, bits);
  for_each_point(draft, [=](Point& p) {
    // Adding 0.0 turns -0 into 0, because -0 is written differently.
    for (double& c : p) c = std::floor(c * scale * unit + 0.5) / unit + 0.0;
  });
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
  // An oracle is slowest at exact numbers with 1074 bits below the point, beside ordinary numbers.
  // So only small meshes get them.
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
      Point& p = one_of(random, one_of(random, draft.frames));
      p[at(random.below(3))] = std::ldexp(random.between(-3, 3), least_exponent) + 0.0;
    }
  }
  draft.tag("menu:denormal");
}

namespace {

double tiny(Random& random) {
  const double mantissa = random.signed_unit();
  return std::ldexp(mantissa, -random.between(20, 45));
}

// Returns a place on the face but for a tiny offset: at a vertex, on an edge, or inside.
Point beside(Random& random, const Points& x, const Face& f, int kind) {
  const Point &a = at(x, f[0]), &b = at(x, f[1]), &c = at(x, f[2]);
  const Point offset = {tiny(random), tiny(random), tiny(random)};
  const double s = random.unit();
  if (kind == 0) return a + offset;
  if (kind == 1) return between(a, b, s) + offset;
  return between(between(a, b, s), c, random.unit()) + offset;
}

void put_beside(Random& random, Draft& draft) {
  const Face own = one_of(random, draft.faces), target = one_of(random, draft.faces);
  const std::int32_t v = own[at(random.below(3))];
  // If the target holds v, it becomes a sliver: v goes to the opposite edge.
  const bool sliver = target[0] == v || target[1] == v || target[2] == v;
  Face f = target;
  while (sliver && f[2] != v) f = {f[1], f[2], f[0]};
  const int kind = sliver ? 1 : random.below(3);
  const bool always = random.one_in(4);
  // Mostly a later frame is chosen, so that the start stays clean.
  const auto only = draft.frames.size() - 1 - (random.one_in(4) ? 1 : 0);
  for (std::size_t k = 0; k < draft.frames.size(); ++k) {
    Points& x = draft.frames[k];
    if (always || k == only) at(x, v) = beside(random, x, f, kind);
  }
  draft.tag(sliver ? "menu:sliver" : "menu:near-coincidence");
}

}  // namespace

void miss_nearly(Random& random, Draft& draft) {
  const int kind = random.below(3);
  if (kind <= 1) place_ulp_neighbours(random, draft);
  if (kind >= 1) put_beside(random, draft);
}

namespace {

void choose_bodies(Random& random, const Case& c, CountedPairs& pairs) {
  const auto mesh = detector::make_topology(c.triangles, c.frames.front().rows());
  const int most = 3;
  const int bodies = std::min(most, static_cast<int>(mesh.components.size()));
  pairs.body.assign(static_cast<std::size_t>(c.frames.front().rows()), 0);
  for (std::size_t part = 0; part < mesh.components.size(); ++part) {
    for (const auto t : mesh.components[part].triangles) {
      for (const auto v : mesh.triangles[at(t)])
        pairs.body[at(v)] = static_cast<std::int32_t>(part) % bodies;
    }
  }
  const int count = random.between(1, 2);
  for (int n = 0; n < count; ++n) {
    const int a = random.below(bodies);
    pairs.apart.push_back({a, random.below(bodies)});
  }
}

// Returns the length of some edge as a sum of magnitudes, which has the same bits on every machine.
double length_of_some_edge(Random& random, const Case& c) {
  const auto t = random.below(static_cast<int>(c.triangles.rows()));
  const auto& x = c.frames.front();
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += std::abs(x(c.triangles(t, 0), k) - x(c.triangles(t, 1), k));
  return sum;
}

// Leaves out two features of the pair, unless the drawn ones share a vertex.
void leave_out_features(Random& random, const Case& c, const TrianglePair& pair,
                        CountedPairs& pairs) {
  const auto [of, face] = random.one_in(2) ? std::pair(pair.a, pair.b) : std::pair(pair.b, pair.a);
  const auto rotation_of = [&](std::int32_t t) {
    Face corners = {c.triangles(t, 0), c.triangles(t, 1), c.triangles(t, 2)};
    std::rotate(corners.begin(), corners.begin() + random.below(3), corners.end());
    return corners;
  };
  const Face a = rotation_of(of), b = rotation_of(face);
  const std::array edge_a = {a[0], a[1]}, edge_b = {b[0], b[1]};
  if (random.one_in(2)) {
    if (!has(b, a[0])) pairs.vertex_faces.push_back({a[0], face});
  } else if (std::find_first_of(edge_a.begin(), edge_a.end(), edge_b.begin(), edge_b.end()) ==
             edge_a.end()) {
    pairs.edge_pairs.push_back({edge_a, edge_b});
  }
}

}  // namespace

CountedPairs relation_without(LeftOut left_out, Random& random, const Case& c,
                              std::span<const PairContact> in_contact) {
  CountedPairs pairs;
  pairs.level =
      random.one_in(4) ? detector::CountedLevel::features : detector::CountedLevel::triangles;
  switch (left_out) {
    case LeftOut::nothing:
      break;
    case LeftOut::bodies:
      choose_bodies(random, c, pairs);
      break;
    case LeftOut::rings:
      pairs.rings = random.between(1, 2);
      break;
    case LeftOut::near_at_rest: {
      const double length = length_of_some_edge(random, c);
      const double nearer = std::ldexp(length, -random.between(0, 10));
      if (!std::isfinite(nearer)) break;
      pairs.rest_distance = nearer;
      pairs.rest = corpus::points_of(one_of(random, c.frames));
      break;
    }
    case LeftOut::single_pairs:
      for (const auto& contact : in_contact) {
        if (random.one_in(2)) continue;
        if (pairs.level == detector::CountedLevel::features) {
          leave_out_features(random, c, contact.pair, pairs);
        } else {
          pairs.triangle_pairs.push_back(contact.pair);
        }
      }
  }
  return pairs;
}

void add_relation(Random& random, RandomCase& random_case) {
  Case& c = random_case.c;
  CountedPairs pairs;
  pairs.level =
      random.one_in(2) ? detector::CountedLevel::triangles : detector::CountedLevel::features;
  if (random.one_in(2)) choose_bodies(random, c, pairs);
  if (random.one_in(2)) pairs.rings = random.between(1, 2);
  const double length = length_of_some_edge(random, c);
  if (random.one_in(3) && std::isfinite(length)) pairs.rest_distance = length / 2;
  if (pairs.count_all()) pairs.rings = 1;
  if (pairs.rest_distance > 0) pairs.rest = corpus::points_of(c.frames.front());
  random_case.tags.push_back(std::string("relation:") + name_of(pairs.level));
  if (!pairs.apart.empty()) random_case.tags.push_back("relation:bodies");
  if (pairs.rings > 0) random_case.tags.push_back("relation:rings");
  if (pairs.rest_distance > 0) random_case.tags.push_back("relation:rest-distance");
  std::ranges::sort(random_case.tags);
  c.counted = corpus::CaseRelation{std::move(pairs), {}};
}

}  // namespace assay::properties
