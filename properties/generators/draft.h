// A deforming mesh in the making: generators of shapes, motions, aims and primitives work on it in
// turn. Coordinates are of the order of 1 until the last of them scales or moves the whole.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "properties/generators/generated_case.h"
#include "properties/generators/points.h"
#include "properties/numbering.h"
#include "properties/random.h"

namespace assay::properties {

using Face = std::array<std::int32_t, 3>;

struct Draft {
  std::vector<Face> faces;
  std::vector<Points> frames;  // one until a motion adds more
  // All triangles are positive from the origin at the start, or nearly: convex and star shapes.
  bool star_shaped = false;
  // A segment along the middle of the shape: a good view-line.
  std::array<Point, 2> axis = {{{0, 0, -0.5}, {0, 0, 0.5}}};
  // Vertices from here on belong to a second piece; 0 when there is one.
  std::int32_t second_piece = 0;
  Points holes;               // centres of holes at the start
  std::vector<Point> q0, q1;  // view primitive, by frame; q1 empty for a point, both for none
  std::vector<std::string> tags;

  Points& rest() { return frames.front(); }
  const Points& rest() const { return frames.front(); }
  std::int32_t vertices() const { return static_cast<std::int32_t>(rest().size()); }
  std::int32_t vertex(const Point& x) {
    rest().push_back(x);
    return vertices() - 1;
  }
  // Corners counter-clockwise seen from outside; split along ac.
  void quad(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  }
  void tag(std::string word) { tags.push_back(std::move(word)); }
};

inline const Point& at(const Points& x, std::int32_t v) { return x[static_cast<std::size_t>(v)]; }
inline Point& at(Points& x, std::int32_t v) { return x[static_cast<std::size_t>(v)]; }

inline bool has(const Face& f, std::int32_t v) { return f[0] == v || f[1] == v || f[2] == v; }

// REQUIRES a non-empty list.
template <class List>
auto& any_of(Random& random, List& list) {
  return list[at(random.below(static_cast<int>(std::size(list))))];
}

// Drops vertices that no face uses, and numbers the rest in their order.
void drop_unused_vertices(Draft& draft);

// Drops all but the first of the faces with the same three vertices, and those that repeat one.
void drop_invalid_faces(Draft& draft);

// Each edge (u,v) as often as (v,u).
bool is_cycle(const std::vector<Face>& faces);

// The case; tags sorted, each once.
GeneratedCase finished(Draft draft, std::string id);

}  // namespace assay::properties
