#include "properties/generators/shapes/closed_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace assay::properties {
namespace {

// Joins two drafts. The vertices of `b` follow those of `a`.
Draft joined(Draft a, const Draft& b) {
  const auto offset = a.vertices();
  a.second_piece = offset;
  a.star_shaped = false;
  a.rest().insert(a.rest().end(), b.rest().begin(), b.rest().end());
  for (const auto& f : b.faces) a.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
  a.tags.insert(a.tags.end(), b.tags.begin(), b.tags.end());
  return a;
}

void scale_and_move(Draft& d, double scale, const Point& by) {
  for (auto& p : d.rest()) p = scale * p + by;
}

// The least and the greatest x of the draft.
std::array<double, 2> extent(const Draft& d) {
  const auto [low, high] = std::minmax_element(
      d.rest().begin(), d.rest().end(), [](const Point& a, const Point& b) { return a[0] < b[0]; });
  return {(*low)[0], (*high)[0]};
}

// Two pieces stand side by side along x, with a gap between a hair and half a unit.
Draft two_pieces(Random& random, int size) {
  Draft a = simple_shape(random, size / 2), b = simple_shape(random, size / 2);
  const double gap = random.between(1, 32) / 64.0;
  scale_and_move(b, 1, {extent(a)[1] - extent(b)[0] + gap, 0, 0});
  Draft d = joined(std::move(a), b);
  d.tag("pieces:apart");
  return d;
}

Draft nested(Random& random, int size, bool inward) {
  Draft a = star_shape(random, std::max(4, size / 2)), b = star_shape(random, size / 2);
  double inner = 1e9, outer = 0;
  for (const auto& p : a.rest()) inner = std::min(inner, dot(p, p));
  for (const auto& p : b.rest()) outer = std::max(outer, dot(p, p));
  scale_and_move(b, random.between(1, 3) / 8.0 * std::sqrt(inner / outer), {0, 0, 0});
  if (inward) {
    for (auto& f : b.faces) std::swap(f[1], f[2]);
  }
  Draft d = joined(std::move(a), b);
  d.tag(inward ? "pieces:cavity" : "pieces:nested");
  return d;
}

// The highest vertex of one piece along x is the lowest of the other.
Draft sharing_a_vertex(Random& random, int size) {
  Draft a = simple_shape(random, size / 2), b = simple_shape(random, size / 2);
  std::int32_t high = 0, low = 0;
  for (std::int32_t v = 0; v < a.vertices(); ++v) {
    if (at(a.rest(), v)[0] > at(a.rest(), high)[0]) high = v;
  }
  for (std::int32_t v = 0; v < b.vertices(); ++v) {
    if (at(b.rest(), v)[0] < at(b.rest(), low)[0]) low = v;
  }
  scale_and_move(b, 1, at(a.rest(), high) - at(b.rest(), low));
  const std::int32_t kept = high, gone = a.vertices() + low;
  Draft d = joined(std::move(a), b);
  for (auto& f : d.faces) std::replace(f.begin(), f.end(), gone, kept);
  drop_unused_vertices(d);
  d.tag("pieces:at-a-vertex");
  return d;
}

// Two tetrahedra share an edge. They lie beside each other, or one within the other.
Draft sharing_an_edge(Random& random, int) {
  Draft d;
  const double side = random.below(3) == 0 ? 1 : -1;
  d.frames.push_back({{0, 0, -1},
                      {0, 0, 1},
                      {2, -1.5, 0},
                      {2, 1.5, 0},
                      {side * 1, -side * 0.375, 0},
                      {side * 1.25, side * 0.25, 0}});
  d.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3},
             {0, 4, 1}, {0, 1, 5}, {0, 5, 4}, {1, 4, 5}};
  // The order above is outward for one orientation of the axes only.
  Point centre = mean({d.rest()[0], d.rest()[1], d.rest()[2], d.rest()[3]});
  const auto& x = d.rest();
  if (dot(x[0] - centre, cross(x[2] - x[0], x[1] - x[0])) < 0) {
    for (auto& f : d.faces) std::swap(f[1], f[2]);
  }
  d.second_piece = 4;
  d.tag("pieces:at-an-edge");
  d.tag("shape:tetrahedron");
  return d;
}

}  // namespace

Draft closed_shape(Random& random, int size) {
  const int kind = random.below(13);
  if (size < 8 || kind < 7) return simple_shape(random, size);
  switch (kind) {
    case 7:
      return nested(random, size, true);
    case 8:
      return nested(random, size, false);
    case 9:
      return sharing_a_vertex(random, size);
    case 10:
      return size <= 16 ? sharing_an_edge(random, size) : sharing_a_vertex(random, size);
    default:
      return two_pieces(random, size);
  }
}

}  // namespace assay::properties
