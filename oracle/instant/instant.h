// The exact places of a mesh's vertices at one instant of a step, as integers.
#pragma once

#include <algorithm>
#include <vector>

#include "oracle/mesh/box_tree.h"
#include "oracle/query/integer_polynomial.h"

namespace assay::oracle {

using IntegerPoint = std::array<Integer, 3>;

// t = numerator / denominator, in [0,1].
struct RationalTime {
  std::int64_t numerator = 0, denominator = 1;
};

// Vertex v is at points()[v] * unit, with one unit for all: 2^exponent() / denominator of the time.
// Signs of homogeneous polynomials of differences are those of the true places.
class Instant {
 public:
  // Vertices at rest at x. REQUIRES finite coordinates.
  explicit Instant(const detector::PositionsView& x);
  // Vertices on their way from x_t0 to x_t1.
  // REQUIRES 0 <= numerator <= denominator, 0 < denominator < 2^31.
  Instant(const detector::PositionsView& x_t0, const detector::PositionsView& x_t1,
          const RationalTime& t);

  const std::vector<IntegerPoint>& points() const { return points_; }
  // A double in the units of points(): a rational.
  mpq_class in_units(double coordinate) const;
  mpq_class in_units(const mpq_class& coordinate) const;

  // Doubles that enclose the place of a vertex; both bounds are the coordinate where it is a
  // double.
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
