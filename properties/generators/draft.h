// A deforming mesh in the making: generators of shapes, motions, aims and primitives work on it in
// turn. Coordinates are of the order of 1 until the last generator scales or moves the whole mesh.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "properties/numbering.h"

namespace assay::properties {

class Random;

// A random case, with tags that say how it was made.

// tags: "closed", "shape:torus", "holes:2", "motion:twist", "menu:ulp", "aim:edge", ...; each once,
// ascending. They say what the generator aimed at. Only the oracle can tell whether, say, an aimed
// contact is the first one of its step.
struct RandomCase {
  Case c;
  std::vector<std::string> tags;
};

// Small vector arithmetic for generators: plain sums, which give the same bytes on every machine.
// For the same reason no expression here or in the generators draws two random numbers in an order
// that the language leaves open (arguments of a call, operands of +).

using Points = std::vector<Point>;

inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
// Returns `a` if s = 0, and `b` if s = 1.
inline Point between(const Point& a, const Point& b, double s) { return a + s * (b - a); }

// Returns a vector with each coordinate in [-1, 1).
Point any_vector(Random& random);
Point integer_point(Random& random, int reach);  // in [-reach, reach]

inline Point mean(const Points& points) {
  Point sum = {0, 0, 0};
  for (const auto& p : points) sum = sum + p;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

using Face = std::array<std::int32_t, 3>;

// Where these vertices land in a frame: on the plane of a face whose corners have the same
// coordinate along `axis`, or `units` units of the last place beyond the plane. `way` is the
// displacement by which the vertices come there.
struct Landing {
  std::size_t frame = 0;
  std::vector<std::int32_t> vertices;
  Face face{};
  std::size_t axis = 0;
  Point way{};
  int units = 0;
};

struct Draft {
  std::vector<Face> faces;
  std::vector<Points> frames;  // one frame until a motion adds more
  // All triangles are positive from the origin at the start, or nearly so. True for convex and
  // star shapes.
  bool star_shaped = false;
  // A segment along the middle of the shape: a good view-line.
  std::array<Point, 2> axis = {{{0, 0, -0.5}, {0, 0, 0.5}}};
  // Vertices from this index on belong to a second piece; 0 if there is one piece only.
  std::int32_t second_piece = 0;
  Points holes;                   // centres of holes at the start
  std::vector<Landing> landings;  // use_everyday_numbers carries them out
  Points closing;  // by vertex, the displacement that closes the shape to a ring; empty: none
  std::vector<Point> q0, q1;  // view primitive by frame; q1 empty: a point; both empty: none
  std::vector<std::string> tags;

  Points& rest() { return frames.front(); }
  const Points& rest() const { return frames.front(); }
  std::int32_t vertices() const { return static_cast<std::int32_t>(rest().size()); }
  std::int32_t vertex(const Point& x) {
    rest().push_back(x);
    return vertices() - 1;
  }
  // Adds the quad abcd as two triangles, split along ac. Its corners are counter-clockwise as seen
  // from outside.
  void quad(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  }
  void tag(std::string word) { tags.push_back(std::move(word)); }
};

inline const Point& at(const Points& x, std::int32_t v) { return x[static_cast<std::size_t>(v)]; }
inline Point& at(Points& x, std::int32_t v) { return x[static_cast<std::size_t>(v)]; }

inline bool has(const Face& f, std::int32_t v) { return f[0] == v || f[1] == v || f[2] == v; }

// Joins two drafts that have one frame each. The vertices of `b` follow those of `a`.
Draft joined(Draft a, const Draft& b);

// Drops vertices that no face uses, and renumbers the others in their order.
void drop_unused_vertices(Draft& draft);

// Drops faces that repeat a vertex, and all but the first of the faces with the same three
// vertices.
void drop_invalid_faces(Draft& draft);

// Returns whether each edge (u,v) occurs as often as (v,u).
bool is_cycle(const std::vector<Face>& faces);

// Returns the greatest magnitude of a coordinate in the frames of the case.
double greatest_of(const Case& c);

// Turns the draft into a case. The tags of the case are sorted, without duplicates.
RandomCase finished(Draft draft, std::string id);

}  // namespace assay::properties
