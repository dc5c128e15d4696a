#include "oracle/mesh/feature_distance.h"

#include <algorithm>
#include <utility>

#include "oracle/query/contact.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

namespace {

using Place = std::array<mpq_class, 3>;

Place place_of(const detector::Point& x) {
  return {mpq_class(x[0]), mpq_class(x[1]), mpq_class(x[2])};
}

mpq_class squared(const Place& a) { return dot(a, a); }

Place along(const Place& from, const Place& direction, const mpq_class& share) {
  return {from[0] + share * direction[0], from[1] + share * direction[1],
          from[2] + share * direction[2]};
}

mpq_class squared_distance_to(const Place& p, const Place& a, const Place& b) {
  const Place edge = b - a, to = p - a;
  const mpq_class length = squared(edge);
  if (length == 0) return squared(to);
  const mpq_class share = dot(to, edge) / length;
  if (share <= 0) return squared(to);
  if (share >= 1) return squared(p - b);
  return squared(to - along({}, edge, share));
}

// Returns the squared distance, which is a convex function of the two places on the edges, so it is
// least at an end of an edge, or where both derivatives are 0.
mpq_class squared_distance_of_edges(const Place& a, const Place& b, const Place& c,
                                    const Place& d) {
  mpq_class least = std::min({squared_distance_to(a, c, d), squared_distance_to(b, c, d),
                              squared_distance_to(c, a, b), squared_distance_to(d, a, b)});
  const Place u = b - a, v = d - c, w = a - c;
  const mpq_class uu = squared(u), vv = squared(v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
  const mpq_class determinant = uu * vv - uv * uv;
  if (determinant == 0) return least;  // parallel, or points
  const mpq_class s = (uv * vw - vv * uw) / determinant, t = (uu * vw - uv * uw) / determinant;
  if (s < 0 || s > 1 || t < 0 || t > 1) return least;
  return std::min(least, squared(along(a, u, s) - along(c, v, t)));
}

// Returns the squared distance to the plane if the point is above the inside of the face, else that
// to an edge.
mpq_class squared_distance_to_face(const Place& p, const Place& a, const Place& b, const Place& c) {
  mpq_class least = std::min(
      {squared_distance_to(p, a, b), squared_distance_to(p, b, c), squared_distance_to(p, c, a)});
  const Place normal = cross(b - a, c - a);
  const mpq_class length = squared(normal);
  if (length == 0) return least;
  const auto is_inside = [&](const Place& from, const Place& to) {
    return dot(normal, cross(to - from, p - from)) >= 0;
  };
  if (!is_inside(a, b) || !is_inside(b, c) || !is_inside(c, a)) return least;
  const mpq_class height = dot(normal, p - a);
  return std::min(least, mpq_class(height * height / length));
}

// Returns whether the distance along some axis alone is not below the limit.
template <class First, class Second>
bool boxes_apart(const std::vector<detector::Point>& places, const First& a, const Second& b,
                 const mpq_class& limit) {
  for (int k = 0; k < 3; ++k) {
    const auto less = [&](std::int32_t u, std::int32_t v) { return places[u][k] < places[v][k]; };
    const auto [a_min, a_max] = std::minmax_element(a.begin(), a.end(), less);
    const auto [b_min, b_max] = std::minmax_element(b.begin(), b.end(), less);
    for (const auto& [low, high] : {std::pair(*a_max, *b_min), std::pair(*b_max, *a_min)}) {
      if (places[high][k] <= places[low][k]) continue;
      const mpq_class gap = mpq_class(places[high][k]) - mpq_class(places[low][k]);
      if (gap >= limit) return true;
    }
  }
  return false;
}

}  // namespace

bool vertex_nearer_than(const std::vector<detector::Point>& places, std::int32_t vertex,
                        const Face& face, double distance) {
  const mpq_class limit(distance);
  if (boxes_apart(places, std::array{vertex}, face, limit)) return false;
  return squared_distance_to_face(place_of(places[vertex]), place_of(places[face[0]]),
                                  place_of(places[face[1]]),
                                  place_of(places[face[2]])) < limit * limit;
}

bool edges_nearer_than(const std::vector<detector::Point>& places, const Edge& a, const Edge& b,
                       double distance) {
  const mpq_class limit(distance);
  if (boxes_apart(places, a, b, limit)) return false;
  return squared_distance_of_edges(place_of(places[a[0]]), place_of(places[a[1]]),
                                   place_of(places[b[0]]), place_of(places[b[1]])) < limit * limit;
}

bool faces_nearer_than(const std::vector<detector::Point>& places, const Face& a, const Face& b,
                       double distance) {
  if (boxes_apart(places, a, b, mpq_class(distance))) return false;
  for (int i = 0; i < 3; ++i) {
    if (vertex_nearer_than(places, a[i], b, distance)) return true;
    if (vertex_nearer_than(places, b[i], a, distance)) return true;
    for (int j = 0; j < 3; ++j) {
      const Edge e = {a[i], a[(i + 1) % 3]}, f = {b[j], b[(j + 1) % 3]};
      if (edges_nearer_than(places, e, f, distance)) return true;
    }
  }
  const auto pierces = [&](const Face& of, int i, const Face& face) {
    return segment_pierces_triangle(places[of[i]], places[of[(i + 1) % 3]],
                                    {places[face[0]], places[face[1]], places[face[2]]});
  };
  for (int i = 0; i < 3; ++i) {
    if (pierces(a, i, b) || pierces(b, i, a)) return true;
  }
  return false;
}

}  // namespace assay::oracle
