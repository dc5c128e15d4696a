// The exact places of a mesh's vertices at one instant of a step, as integers.
#pragma once

#include <algorithm>
#include <vector>

#include "oracle/mesh/box_tree.h"
#include "oracle/query/integer_polynomial.h"
#include "oracle/rational_time.h"

namespace assay::oracle {

using IntegerPoint = std::array<Integer, 3>;

// Vertex v is at points()[v] * unit. The unit, 2^exponent_ / denominator_, is the same for all
// vertices, so a homogeneous polynomial of differences of points() has the sign that it has at the
// true places.
class Instant {
 public:
  // The vertices at rest at x. REQUIRES finite coordinates.
  explicit Instant(const detector::PositionsView& x);
  // The vertices at time t of the step. REQUIRES finite coordinates, and t in [0,1] with a
  // denominator below 2^31.
  Instant(const detector::SteppedMesh& motion, const RationalTime& t);

  const std::vector<IntegerPoint>& points() const { return points_; }
  // A coordinate, given as a double or a rational, in the units of points().
  mpq_class in_units(double coordinate) const;
  mpq_class in_units(const mpq_class& coordinate) const;

  // A box of doubles that holds the place of a vertex. If a coordinate of the place is a double,
  // both bounds are that double.
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

}  // namespace assay::oracle
