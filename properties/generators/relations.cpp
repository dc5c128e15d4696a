#include "properties/generators/relations.h"

#include <algorithm>
#include <cmath>

#include "detector/mesh/topology.h"
#include "properties/random.h"

namespace assay::properties {

namespace {

using detector::CountedPairs;

void choose_bodies(Random& random, const corpus::Case& c, CountedPairs& pairs) {
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

// A sum of magnitudes, so that it has the same bits on every machine.
double length_of_some_edge(Random& random, const corpus::Case& c) {
  const auto t = random.below(static_cast<int>(c.triangles.rows()));
  const auto& x = c.frames.front();
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += std::abs(x(c.triangles(t, 0), k) - x(c.triangles(t, 1), k));
  return sum;
}

// Two features of the pair, unless those that are drawn share a vertex.
void leave_out_features(Random& random, const corpus::Case& c, const detector::TrianglePair& pair,
                        CountedPairs& pairs) {
  const auto [of, face] = random.one_in(2) ? std::pair(pair.a, pair.b) : std::pair(pair.b, pair.a);
  const auto turned = [&](std::int32_t t) {
    Face corners = {c.triangles(t, 0), c.triangles(t, 1), c.triangles(t, 2)};
    std::rotate(corners.begin(), corners.begin() + random.below(3), corners.end());
    return corners;
  };
  const Face a = turned(of), b = turned(face);
  const std::array edge_a = {a[0], a[1]}, edge_b = {b[0], b[1]};
  if (random.one_in(2)) {
    if (!has(b, a[0])) pairs.vertex_faces.push_back({a[0], face});
  } else if (std::find_first_of(edge_a.begin(), edge_a.end(), edge_b.begin(), edge_b.end()) ==
             edge_a.end()) {
    pairs.edge_pairs.push_back({edge_a, edge_b});
  }
}

}  // namespace

CountedPairs relation_without(LeftOut left_out, Random& random, const corpus::Case& c,
                              std::span<const detector::PairContact> in_contact) {
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

void add_relation(Random& random, GeneratedCase& made) {
  corpus::Case& c = made.c;
  CountedPairs pairs;
  pairs.level =
      random.one_in(2) ? detector::CountedLevel::triangles : detector::CountedLevel::features;
  if (random.one_in(2)) choose_bodies(random, c, pairs);
  if (random.one_in(2)) pairs.rings = random.between(1, 2);
  const double length = length_of_some_edge(random, c);
  if (random.one_in(3) && std::isfinite(length)) pairs.rest_distance = length / 2;
  if (pairs.count_all()) pairs.rings = 1;
  if (pairs.rest_distance > 0) pairs.rest = corpus::points_of(c.frames.front());
  made.tags.push_back(std::string("relation:") + name_of(pairs.level));
  if (!pairs.apart.empty()) made.tags.push_back("relation:bodies");
  if (pairs.rings > 0) made.tags.push_back("relation:rings");
  if (pairs.rest_distance > 0) made.tags.push_back("relation:rest-distance");
  std::sort(made.tags.begin(), made.tags.end());
  c.counted = corpus::CaseRelation{std::move(pairs), {}};
}

}  // namespace assay::properties
