// The regions of L16. The signs of their polynomials say when two features are within a distance d.
//
// The two features are within d at t exactly when one of these regions holds at t: when f <= 0 and
// all conditions of the region hold. There is a region for each pair of a closed face of one
// feature and a closed face of the other, where a face of a feature is a corner, an edge or the
// feature itself.
//
//   region          | f                       | g >= 0                           | > 0
//   points p, a     | |p-a|^2 - d^2           | none                             | none
//   p, edge ab      | |w x e|^2 - d^2 |e|^2   | w.e, |e|^2 - w.e                 | |e|^2
//   p, face abc     | ((p-a).N)^2 - d^2 |N|^2 | N.((b-a) x (p-a)), cyclic        | |N|^2
//   edges ab, ce    | (w.N)^2 - d^2 |N|^2     | s, |N|^2 - s, t, |N|^2 - t       | |N|^2
//
//   p, edge ab:     e = b-a, w = p-a
//   p, face abc:    N = (b-a) x (c-a)
//   edges ab, ce:   u = b-a, v = e-c, w = c-a, N = u x v, s = (w x v).N, t = (w x u).N
//
// f compares the distance of the points, lines and planes with d. The conditions g >= 0 say that
// the feet of the perpendicular lie in the two faces. The strict condition says that the edge, the
// face or the pair of edges is not degenerate. If it is degenerate, f vanishes, and regions of
// lower dimension tell the distance.
//
// The times of a region are 0, if the region holds at t=0, and the zeros of f at which the
// conditions hold, unless f is identically zero. The first time within d is the least time of all
// regions. Proof: let tau > 0 be the first time within d, and take a region of least dimension that
// holds at tau. Before tau the features are farther apart than d, so at tau their distance is d,
// and f vanishes at tau. If f is identically zero, some condition fails just before tau, so its g
// vanishes at tau. Then the foot lies on a face of lower dimension, and the region was not of least
// dimension.
//
// The code has the table once, as a template over the kind of number: integers at an instant,
// polynomials over the step, balls over a part of the step.
#pragma once

#include <array>
#include <cstddef>

#include "detector/mesh/types.h"

namespace assay::detector {

template <class Number>
struct NearRegion {
  Number f;
  std::array<Number, 4> not_negative;
  std::size_t conditions = 0;  // how many elements of not_negative are used
  Number positive;             // the strict condition; used if conditions > 0
};

template <class Number>
class NearRegions {
 public:
  using Place = std::array<Number, 3>;

  NearRegions(const std::array<Place, 4>& points, int first_group, const Number& squared_distance)
      : x_(points), first_group_(first_group), squared_(squared_distance) {}

  std::size_t size() const { return first_group_ == 1 ? 7 : 9; }

  // Returns region i. Regions of higher dimension come first: first the face or the two edges, then
  // points and edges, then pairs of points.
  NearRegion<Number> operator[](std::size_t i) const {
    if (first_group_ == 1) {
      if (i == 0) return point_face(x_[0], x_[1], x_[2], x_[3]);
      if (i < 4) return point_edge(x_[0], x_[i], x_[i % 3 + 1]);
      return points(x_[0], x_[i - 3]);
    }
    if (i == 0) return edges(x_[0], x_[1], x_[2], x_[3]);
    if (i < 3) return point_edge(x_[i - 1], x_[2], x_[3]);
    if (i < 5) return point_edge(x_[i - 1], x_[0], x_[1]);
    return points(x_[(i - 5) / 2], x_[2 + (i - 5) % 2]);
  }

 private:
  static Place minus(const Place& p, const Place& q) {
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  }
  static Number dot(const Place& p, const Place& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  }
  static Place cross(const Place& p, const Place& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  }

  NearRegion<Number> points(const Place& p, const Place& a) const {
    const Place w = minus(p, a);
    return {dot(w, w) - squared_, {}, 0, {}};
  }

  NearRegion<Number> point_edge(const Place& p, const Place& a, const Place& b) const {
    const Place e = minus(b, a), w = minus(p, a), area = cross(w, e);
    const Number length = dot(e, e), along = dot(w, e);
    return {dot(area, area) - squared_ * length, {along, length - along}, 2, length};
  }

  NearRegion<Number> point_face(const Place& p, const Place& a, const Place& b,
                                const Place& c) const {
    const Place n = cross(minus(b, a), minus(c, a));
    const Number height = dot(minus(p, a), n), length = dot(n, n);
    const auto beside = [&](const Place& from, const Place& to) {
      return dot(n, cross(minus(to, from), minus(p, from)));
    };
    return {
        height * height - squared_ * length, {beside(a, b), beside(b, c), beside(c, a)}, 3, length};
  }

  NearRegion<Number> edges(const Place& a, const Place& b, const Place& c, const Place& e) const {
    const Place u = minus(b, a), v = minus(e, c), w = minus(c, a), n = cross(u, v);
    const Number height = dot(w, n), length = dot(n, n);
    const Number s = dot(cross(w, v), n), t = dot(cross(w, u), n);
    return {height * height - squared_ * length, {s, length - s, t, length - t}, 4, length};
  }

  const std::array<Place, 4>& x_;
  int first_group_;
  const Number& squared_;
};

enum class Near { within, nearer };  // within: at most d apart; nearer: less than d

// Returns whether some region holds. This means that the features are within the distance (with
// Near::nearer: nearer than it) at the instant that `regions` was made for. Cheap regions are tried
// first.
template <class Number>
bool some_region_holds(const NearRegions<Number>& regions, Near near) {
  for (std::size_t i = regions.size(); i-- > 0;) {
    const auto region = regions[i];
    bool holds = region.f.sign() <= (near == Near::within ? 0 : -1) &&
                 (region.conditions == 0 || region.positive.sign() > 0);
    for (std::size_t g = 0; holds && g < region.conditions; ++g)
      holds = region.not_negative[g].sign() >= 0;
    if (holds) return true;
  }
  return false;
}

// Returns whether two features of a mesh at rest are nearer to each other than r.
// CountedPairs::rest_distance needs this. Exact for all finite inputs, because the regions are
// computed in integers (exact/polynomial.h).
//
// REQUIRES that r is finite. Takes 2 to 10 us, or 10 ns if the boxes of the two features are far
// enough apart.
bool vertex_is_nearer_to_face(const Point& p, const std::array<Point, 3>& face, double r);
bool edges_are_nearer(const std::array<Point, 2>& a, const std::array<Point, 2>& b, double r);

// Does the same for two triangles that share no vertex: true if they pierce each other, or if a
// feature of one is nearer than r to a feature of the other.
bool triangles_are_nearer(const std::array<Point, 3>& a, const std::array<Point, 3>& b, double r);

}  // namespace assay::detector
