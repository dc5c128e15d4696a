// The textbook method, which many simulators use. The times at which four points lie in one plane
// are the roots of a cubic (Provot 1997). At each root the point has to lie in the triangle, or the
// edges have to cross, up to a tolerance. Everything is computed in one number type.
#pragma once

#include <cmath>

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {

template <class Number>
struct Vector {
  Number x, y, z;
  friend Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};
template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Number>
Number triple(const Vector<Number>& a, const Vector<Number>& b, const Vector<Number>& c) {
  return dot(a, cross(b, c));
}

// Real roots, ascending.
template <class Number>
struct Roots {
  int count = 0;
  Number at[3] = {};
  void add(Number t) {
    int i = count++;
    for (; i > 0 && at[i - 1] > t; --i) at[i] = at[i - 1];
    at[i] = t;
  }
};

// `Solver` has `using Number`; `static constexpr Number tolerance`, for barycentric coordinates and
// for times; and `static Roots<Number> roots_of(a, b, c, d)`, the roots of a t^3 + b t^2 + c t + d,
// or none if that polynomial is zero.
template <class Solver>
class CubicTests {
  using Number = typename Solver::Number;
  using V = Vector<Number>;

 public:
  static Time vertex_face(const FourPaths& paths) { return first_time(paths, point_meets); }
  static Time edge_edge(const FourPaths& paths) { return first_time(paths, edges_meet); }

 private:
  static V vector_of(const double* p) {
    return {static_cast<Number>(p[0]), static_cast<Number>(p[1]), static_cast<Number>(p[2])};
  }

  // Returns the place of point i at time t.
  static V place(const FourPaths& paths, int i, Number t) {
    const V p = vector_of(paths.at[0][i]), q = vector_of(paths.at[1][i]);
    return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z)};
  }

  static bool is_inside(Number share) {
    return share >= -Solver::tolerance && share <= 1 + Solver::tolerance;
  }

  // Returns whether the point's projection onto the triangle's plane lies in the triangle, up to
  // the tolerance.
  static bool point_meets(const V& p, const V& a, const V& b, const V& c) {
    const V normal = cross(b - a, c - a);
    const Number area = dot(normal, normal);
    if (area == 0) return false;
    const Number v = dot(cross(p - a, c - a), normal) / area;
    const Number w = dot(cross(b - a, p - a), normal) / area;
    return is_inside(v) && is_inside(w) && is_inside(1 - v - w);
  }

  // Returns whether the nearest points of the edges' lines lie on the edges, up to the tolerance.
  static bool edges_meet(const V& a, const V& b, const V& c, const V& d) {
    const V normal = cross(b - a, d - c);
    const Number area = dot(normal, normal);
    if (area == 0) return false;
    const Number s = dot(cross(c - a, d - c), normal) / area;
    const Number t = dot(cross(c - a, b - a), normal) / area;
    return is_inside(s) && is_inside(t);
  }

  // Returns the first time at which the four points lie in one plane and `meets` holds.
  template <class Meets>
  static Time first_time(const FourPaths& paths, const Meets& meets) {
    V x[4], v[4];  // place at t = 0, and motion, relative to the first point
    for (int i = 1; i < 4; ++i) {
      x[i] = vector_of(paths.at[0][i]) - vector_of(paths.at[0][0]);
      v[i] = vector_of(paths.at[1][i]) - vector_of(paths.at[1][0]) - x[i];
    }
    const Number a = triple(v[1], v[2], v[3]);
    const Number b = triple(x[1], v[2], v[3]) + triple(v[1], x[2], v[3]) + triple(v[1], v[2], x[3]);
    const Number c = triple(x[1], x[2], v[3]) + triple(x[1], v[2], x[3]) + triple(v[1], x[2], x[3]);
    const Number d = triple(x[1], x[2], x[3]);
    const Roots<Number> roots = Solver::roots_of(a, b, c, d);
    for (int i = 0; i < roots.count; ++i) {
      if (!is_inside(roots.at[i])) continue;
      const Number t = std::clamp(roots.at[i], Number(0), Number(1));
      if (meets(place(paths, 0, t), place(paths, 1, t), place(paths, 2, t), place(paths, 3, t)))
        return plugin::Interval{{t, t}};
    }
    return std::nullopt;
  }
};

// Returns the description that all peers of this method have in common; it lacks a name.
inline plugin::Description cubic_description() {
  return usual_description("", "1", ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE);
}

}  // namespace assay::peers
