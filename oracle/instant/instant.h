// A mesh at one instant of a step, in exact numbers: the places of its vertices, which triangles
// meet or cross, and whether features are nearer to each other than a given distance.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "detector/mesh/step_types.h"
#include "oracle/mesh/feature_pairs.h"
#include "oracle/query/integer_polynomial.h"
#include "oracle/rational_time.h"

namespace assay::oracle {

using IntegerPoint = std::array<Integer, 3>;

// Vertex v is at points()[v] * unit. The unit, 2^exponent_ / denominator_, is the same for all
// vertices, so a homogeneous polynomial of differences has the same sign for points() as for the
// true places.
class Instant {
 public:
  // Makes the instant of vertices at rest at x. REQUIRES finite coordinates.
  explicit Instant(const detector::PositionsView& x);
  // Makes the instant at time t of a step. REQUIRES finite coordinates, and t in [0,1] with a
  // denominator below 2^31.
  Instant(const detector::SteppedMesh& motion, const RationalTime& t);

  const std::vector<IntegerPoint>& points() const { return points_; }
  // Returns a coordinate in the units of points().
  mpq_class in_units(const mpq_class& coordinate) const;

  // Returns a box of doubles that holds the place of a vertex. If a coordinate of the place is a
  // double, both bounds are that double.
  const Box& box(std::int32_t vertex) const { return boxes_[vertex]; }
  template <class Vertices>
  Box box_of(const Vertices& vertices) const {
    Box box = boxes_[vertices[0]];
    for (const std::int32_t v : vertices) {
      for (int k = 0; k < 3; ++k) {
        box.min[k] = std::min(box.min[k], boxes_[v].min[k]);
        box.max[k] = std::max(box.max[k], boxes_[v].max[k]);
      }
    }
    return box;
  }

 private:
  std::vector<IntegerPoint> points_;
  std::vector<Box> boxes_;
  int exponent_ = 0;
  Integer denominator_ = 1;
};

// The tests below tell by signs of integer determinants whether features at rest meet. They are as
// complete as the queries of contact.h: they decide degenerate, coplanar, collinear and coinciding
// features too. For degenerate features they are faster (1 to 5 us), because they find no time.

// Features name their vertices by index into the points.
using StaticPoints = std::span<const IntegerPoint>;

// Returns whether two closed features have a point in common. A triangle of zero area is treated as
// the segment or point that it has become. For a piercing edge, returns the condition of
// segment_pierces_triangle of contact.h: the ends lie strictly on opposite sides of the plane of
// the face, and the line passes strictly inside all three of its edges.
bool features_meet(StaticPoints x, const detector::Feature& feature);

// Returns for each triangle 1 if it meets another triangle of its own component, or a ghost of that
// component; else 0. REQUIRES that triangles and ghosts name vertices of this instant. `component`
// lists the component of each triangle, then the component of each ghost.
std::vector<std::uint8_t> touched_at(const Instant& instant,
                                     const detector::TrianglesView& triangles,
                                     const detector::TrianglesView& ghosts,
                                     const std::vector<std::int32_t>& component);

// Returns a pair of triangles that `counts` accepts and that is near, or nothing if there is none.
// A pair is near if it is in contact at rest (as detector/LAWS.md defines contact), or if it holds
// a vertex and a face, or two edges, that share no vertex and are nearer to each other than
// `distance`. Squared distances are compared exactly, in rationals. With distance 0, only pairs in
// contact are near. REQUIRES indices in range, finite positions, a finite distance >= 0. Takes 5 to
// 20 us for each pair of features whose boxes are nearer to each other than `distance`; stops at
// the first near pair.
std::optional<detector::TrianglePair> any_nearer_than(const detector::PositionsView& x,
                                                      const detector::TrianglesView& triangles,
                                                      double distance, const WantedPair& counts);

// Returns whether two triangles at rest cross. They cross if no plane has one triangle on each of
// its closed sides. Triangles that meet and do not cross are said to touch, also if they overlap in
// one plane. Exact; takes 10 to 30 us.
bool triangles_cross(const detector::PositionsView& x, const detector::TrianglesView& triangles,
                     const detector::TrianglePair& pair);

}  // namespace assay::oracle
