#include "detector/geometry/rest_distance.h"

#include <algorithm>
#include <span>

#include "detector/exact/integer.h"
#include "detector/geometry/orientation.h"

namespace assay::detector {
namespace {

using Vector = std::array<Integer, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Integer dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Four points and the square of the distance, all in one unit.
struct Scaled {
  std::array<Vector, 4> points;
  Integer squared;

  Scaled(const std::array<const Point*, 4>& given, double r) {
    std::array<double, 13> values;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 3; ++k) values[3 * i + k] = (*given[i])[k];
    }
    values[12] = r;
    std::array<Integer, 13> integers;
    to_common_integers(values, integers);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 3; ++k) points[i][k] = integers[3 * i + k];
    }
    squared = integers[12] * integers[12];
  }

  bool near(const Vector& p, const Vector& a) const {
    const Vector w = minus(p, a);
    return dot(w, w) < squared;
  }
  // To the edge without its ends.
  bool near(const Vector& p, const Vector& a, const Vector& b) const {
    const Vector e = minus(b, a), w = minus(p, a);
    const Integer length = dot(e, e), foot = dot(w, e);
    if (length == 0 || foot < 0 || foot > length) return false;
    const Vector area = cross(w, e);
    return dot(area, area) < squared * length;
  }
  // To the face without its edges.
  bool near(const Vector& p, const Vector& a, const Vector& b, const Vector& c) const {
    const Vector n = cross(minus(b, a), minus(c, a));
    const Integer length = dot(n, n);
    if (length == 0) return false;
    const auto is_inside = [&](const Vector& from, const Vector& to) {
      return dot(n, cross(minus(to, from), minus(p, from))) >= 0;
    };
    if (!is_inside(a, b) || !is_inside(b, c) || !is_inside(c, a)) return false;
    const Integer height = dot(minus(p, a), n);
    return height * height < squared * length;
  }
  // The edges ab and ce without their ends. The feet are a + (s / |n|^2) u and c + (t / |n|^2) v.
  bool edges_near(const Vector& a, const Vector& b, const Vector& c, const Vector& e) const {
    const Vector u = minus(b, a), v = minus(e, c), w = minus(c, a), n = cross(u, v);
    const Integer length = dot(n, n);
    if (length == 0) return false;
    const Integer s = dot(cross(w, v), n), t = dot(cross(w, u), n);
    if (s < 0 || s > length || t < 0 || t > length) return false;
    const Integer height = dot(w, n);
    return height * height < squared * length;
  }
};

// True only if the two boxes are at least r apart. A rounded difference above r is above it before
// rounding too, because rounding keeps the order of numbers and r is a double.
bool boxes_are_apart(std::span<const Point> a, std::span<const Point> b, double r) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto less = [k](const Point& x, const Point& y) { return x[k] < y[k]; };
    const auto [low_a, high_a] = std::minmax_element(a.begin(), a.end(), less);
    const auto [low_b, high_b] = std::minmax_element(b.begin(), b.end(), less);
    if ((*low_b)[k] - (*high_a)[k] > r || (*low_a)[k] - (*high_b)[k] > r) return true;
  }
  return false;
}

}  // namespace

bool vertex_is_nearer_to_face(const Point& p, const std::array<Point, 3>& face, double r) {
  if (boxes_are_apart({&p, 1}, face, r)) return false;
  const Scaled x({&p, &face[0], &face[1], &face[2]}, r);
  const auto& [q, a, b, c] = x.points;
  return x.near(q, a) || x.near(q, b) || x.near(q, c) || x.near(q, a, b) || x.near(q, b, c) ||
         x.near(q, c, a) || x.near(q, a, b, c);
}

bool edges_are_nearer(const std::array<Point, 2>& first, const std::array<Point, 2>& second,
                      double r) {
  if (boxes_are_apart(first, second, r)) return false;
  const Scaled x({&first[0], &first[1], &second[0], &second[1]}, r);
  const auto& [a, b, c, e] = x.points;
  return x.near(a, c) || x.near(a, e) || x.near(b, c) || x.near(b, e) || x.near(a, c, e) ||
         x.near(b, c, e) || x.near(c, a, b) || x.near(e, a, b) || x.edges_near(a, b, c, e);
}

bool triangles_are_nearer(const std::array<Point, 3>& a, const std::array<Point, 3>& b, double r) {
  if (boxes_are_apart(a, b, r)) return false;
  const auto edge = [](const std::array<Point, 3>& of, std::size_t i) {
    return std::array<Point, 2>{of[i], of[(i + 1) % 3]};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (vertex_is_nearer_to_face(a[i], b, r) || vertex_is_nearer_to_face(b[i], a, r)) return true;
    for (std::size_t j = 0; j < 3; ++j) {
      if (edges_are_nearer(edge(a, i), edge(b, j), r)) return true;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto of_a = edge(a, i), of_b = edge(b, i);
    if (segment_pierces_triangle(of_a[0], of_a[1], b) ||
        segment_pierces_triangle(of_b[0], of_b[1], a)) {
      return true;
    }
  }
  return false;
}

}  // namespace assay::detector
