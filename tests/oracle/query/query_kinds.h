// Random queries, of the kinds on which methods are compared.
#pragma once

#include "tests/oracle/random_points.h"

namespace assay::oracle::test {

enum class QueryKind {
  generic,           // random points of a cube at both ends
  mesh_like,         // features near each other, which move by a part of their size
  small_integers,    // points of a tiny grid: often degenerate, in every way
  exact_contact,     // a touch at a given time, inside, on an edge or on a vertex
  near_contact,      // exact_contact, moved by up to two units in the last place
  near_grazing,      // near_contact, with a tangential touch
  near_contact_far,  // near_contact, away from the origin
};
constexpr int query_kinds = 7;

inline const char* name_of(QueryKind kind) {
  constexpr std::array<const char*, query_kinds> names = {
      "generic",      "mesh-like",    "small integers",        "exact contact",
      "near contact", "near grazing", "near contact, far off",
  };
  return names[static_cast<std::size_t>(kind)];
}

inline bool is_near_degenerate(QueryKind kind) {
  return kind == QueryKind::near_contact || kind == QueryKind::near_grazing ||
         kind == QueryKind::near_contact_far;
}

// Four moving points. The first `first_group` points are one feature, and the other points are the
// other feature.
using Points = std::array<detector::MovingPoint, 4>;

inline double moved_by_ulps(double x, int ulps) {
  const double towards = ulps > 0 ? HUGE_VAL : -HUGE_VAL;
  for (int i = 0; i < std::abs(ulps); ++i) x = std::nextafter(x, towards);
  return x;
}

// Returns a query with an exact contact at t = 0, 1/4, 1/2, 3/4 or 1. All its numbers are dyadic
// and have few bits.
inline Points touching_points(Random& random, int first_group, bool grazing, double offset) {
  const double t = random.below(5) / 4.0;
  const auto dyadic = [&] { return std::ldexp(random.integer(1 << 12), -12); };
  std::array<detector::Point, 4> at, velocity;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      at[i][k] = dyadic();
      velocity[i][k] = dyadic();
    }
  }
  // Weights in eighths. Zeros put the place on an edge or on a vertex.
  const auto eighth = [&] { return random.below(9) / 8.0; };
  const double a = eighth(), b = random.below(3) == 0 ? 0 : eighth() * (1 - a);
  for (int k = 0; k < 3; ++k) {
    if (first_group == 1) {
      at[0][k] = at[1][k] + a * (at[2][k] - at[1][k]) + b * (at[3][k] - at[1][k]);
    } else {
      // a0 such that a0 + a (a1 - a0) = b0 + b (b1 - b0), solved for a multiple of the unit:
      // with a1 = a0 + d, a0 = b0 + b (b1 - b0) - a d.
      const double d = at[1][k] - at[0][k];
      at[0][k] = at[2][k] + b * (at[3][k] - at[2][k]) - a * d;
      at[1][k] = at[0][k] + d;
    }
  }
  if (grazing) {
    // The first feature slides along an edge of the other feature, and nothing else moves relative
    // to it, so the four points stay in one plane.
    const double slide = dyadic();
    for (int k = 0; k < 3; ++k) {
      const int other = first_group;
      const double along = slide * (at[other + 1][k] - at[other][k]);
      for (int i = 0; i < 4; ++i) velocity[i][k] = velocity[3][k];
      for (int i = 0; i < first_group; ++i) velocity[i][k] += along;
    }
  }
  Points x;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      x[i].t0[k] = at[i][k] - t * velocity[i][k] + offset;
      x[i].t1[k] = at[i][k] + (1 - t) * velocity[i][k] + offset;
    }
  }
  return x;
}

inline Points random_query(Random& random, QueryKind kind, int first_group) {
  Points x;
  if (kind == QueryKind::generic || kind == QueryKind::small_integers) {
    const auto coordinates =
        kind == QueryKind::generic ? Coordinates::generic : Coordinates::tiny_grid;
    for (auto& p : x) p = random_point(random, coordinates);
    return x;
  }
  if (kind == QueryKind::mesh_like) {
    for (auto& p : x) {
      p = random_point(random, Coordinates::generic);
      for (int k = 0; k < 3; ++k) p.t1[k] = p.t0[k] + 0.3 * p.t1[k];
    }
    return x;
  }
  const double offset = kind == QueryKind::near_contact_far ? 4096 : 0;
  x = touching_points(random, first_group, kind == QueryKind::near_grazing, offset);
  if (kind == QueryKind::exact_contact) return x;
  for (auto& p : x) {
    for (int k = 0; k < 3; ++k) {
      p.t0[k] = moved_by_ulps(p.t0[k], static_cast<int>(random.integer(2)));
      p.t1[k] = moved_by_ulps(p.t1[k], static_cast<int>(random.integer(2)));
    }
  }
  return x;
}

inline detector::VertexFace vertex_face(const Points& x) { return {x[0], {x[1], x[2], x[3]}}; }
inline detector::EdgeEdge edge_edge(const Points& x) { return {{x[0], x[1]}, {x[2], x[3]}}; }

// Calls law(query) for `queries` queries of each kind, until a query breaks the law.
template <class Law>
void for_each_kind(Random& random, std::uint64_t queries, const Law& law) {
  for (int kind = 0; kind < query_kinds; ++kind) {
    for (std::uint64_t i = 0; i < queries; ++i) {
      const int first_group = 1 + static_cast<int>(i % 2);
      law(detector::FourPoints{random_query(random, static_cast<QueryKind>(kind), first_group),
                               first_group});
      ASSERT_FALSE(testing::Test::HasFailure())
          << name_of(static_cast<QueryKind>(kind)) << " " << i;
    }
  }
}

}  // namespace assay::oracle::test
