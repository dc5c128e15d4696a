#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

#include "properties/laws/facts/case_facts.h"
#include "properties/numbering.h"

namespace assay::properties {

namespace {

constexpr int mantissa_bits = 53;
constexpr int weight_bits = 4;

// Returns the least exponent e such that every coordinate is a multiple of 2^e.
int common_exponent(std::span<const MovingPoint* const> points) {
  int least = 0;
  bool is_found = false;
  for (const auto* p : points) {
    for (const auto& place : {p->t0, p->t1}) {
      for (const double c : place) {
        if (c == 0) continue;
        int exponent = 0;
        std::frexp(c, &exponent);
        least = is_found ? std::min(least, exponent - mantissa_bits) : exponent - mantissa_bits;
        is_found = true;
      }
    }
  }
  return least;
}

ExactInteger integer(double c, int unit) {
  int exponent = 0;
  const double mantissa = std::frexp(c, &exponent);
  ExactInteger value = static_cast<std::int64_t>(std::ldexp(mantissa, mantissa_bits));
  if (value != 0) value <<= exponent - mantissa_bits - unit;
  return value;
}

ExactPoint operator-(const ExactPoint& a, const ExactPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

ExactInteger dot(const ExactPoint& a, const ExactPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

ExactPoint cross(const ExactPoint& a, const ExactPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

ExactView::ExactView(const std::array<MovingPoint, 3>& triangle, const ViewPrimitive& primitive,
                     int eighths) {
  const std::array<const MovingPoint*, 5> all = {&triangle[0], &triangle[1], &triangle[2],
                                                 &primitive.q0, &primitive.q1};
  const int unit = common_exponent(all);
  const auto place = [&](const MovingPoint& p) {
    ExactPoint x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = (8 - eighths) * integer(p.t0[k], unit) + eighths * integer(p.t1[k], unit);
      x[k] <<= weight_bits;
    }
    return x;
  };
  for (std::size_t i = 0; i < 3; ++i) triangle_[i] = place(triangle[i]);
  q0_ = place(primitive.q0);
  q1_ = place(primitive.q1);
  d_ = q1_ - q0_;
  normal_ = cross(triangle_[1] - triangle_[0], triangle_[2] - triangle_[0]);
  length2_ = dot(d_, d_);
  if (length2_ == 0) length2_ = 1;
}

ExactPoint ExactView::corner(int i) const { return triangle_[at(i)]; }

ExactPoint ExactView::inner_point(const std::array<int, 3>& sixteenths) const {
  ExactPoint x;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = sixteenths[0] * triangle_[0][k] + sixteenths[1] * triangle_[1][k] +
           sixteenths[2] * triangle_[2][k];
    x[k] >>= weight_bits;  // exact: corners are multiples of 2^4
  }
  return x;
}

ExactInteger ExactView::axial(const ExactPoint& x) const { return dot(x - q0_, d_); }

Region ExactView::region_of(const ExactPoint& x) const {
  const ExactInteger s = axial(x);
  return s <= 0 ? Region::r0 : s >= length2_ ? Region::r1 : Region::r2;
}

bool ExactView::has_zero_area() const { return dot(normal_, normal_) == 0; }

ExactInteger ExactView::by_clamp(const ExactPoint& x) const {
  // f0 and f1 are the same for every point of the plane of the triangle, so they are computed at a
  // corner.
  const ExactInteger f0 = dot(triangle_[0] - q0_, normal_), f1 = dot(triangle_[0] - q1_, normal_);
  const ExactInteger s = std::clamp<ExactInteger>(axial(x), 0, length2_);
  return (length2_ - s) * f0 + s * f1;
}

ExactInteger ExactView::by_region(const ExactPoint& x) const {
  switch (region_of(x)) {
    case Region::r0:
      return length2_ * dot(x - q0_, normal_);
    case Region::r1:
      return length2_ * dot(x - q1_, normal_);
    case Region::r2:
      break;
  }
  // This is |d|^2 times the vector from the foot q0 + s d to x.
  const ExactInteger s = axial(x);
  ExactPoint from_foot = x - q0_;
  for (std::size_t k = 0; k < 3; ++k) from_foot[k] = length2_ * from_foot[k] - s * d_[k];
  return dot(from_foot, normal_);
}

namespace {
using Vector = Eigen::Vector3d;

Vector at(const MovingPoint& p, double t) {
  const Vector from(p.t0[0], p.t0[1], p.t0[2]), to(p.t1[0], p.t1[1], p.t1[2]);
  return (1 - t) * from + t * to;
}

// Returns (x - n(x)).N, times the constant |d|^2 if the primitive is a segment. This is the clamp
// form of L1.
double view_value(const Vector& x, const Vector& q0, const Vector& q1, const Vector& normal) {
  const Vector along = q1 - q0;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp((x - q0).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (x - q0 - share * along).dot(normal);
}

double greatest(const PositionsView& x) { return x.rows() == 0 ? 0 : x.cwiseAbs().maxCoeff(); }

}  // namespace

ValueRange view_range(const detector::Topology& surface, std::span<const std::int32_t> triangles,
                      const SteppedMesh& motion, const ViewPrimitive& primitive) {
  constexpr int times = 17;
  double size = std::max(greatest(motion.vertices_t0), greatest(motion.vertices_t1));
  for (const auto* q : {&primitive.q0, &primitive.q1}) {
    for (int k = 0; k < 3; ++k) size = std::max({size, std::abs(q->t0[k]), std::abs(q->t1[k])});
  }
  int exponent = 0;
  std::frexp(size, &exponent);
  const auto scaled = [&](MovingPoint p) {
    for (auto* place : {&p.t0, &p.t1}) {
      for (double& c : *place) c = std::ldexp(c, -exponent);
    }
    return p;
  };
  const MovingPoint q0 = scaled(primitive.q0), q1 = scaled(primitive.q1);
  ValueRange range;
  for (const auto t : triangles) {
    std::array<MovingPoint, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = scaled(motion.path(surface.triangles[at(t)][i]));
    }
    bool positive = false, negative = false;
    for (int k = 0; k < times; ++k) {
      const double time = k / (times - 1.0);
      const Vector p0 = at(corners[0], time), p1 = at(corners[1], time), p2 = at(corners[2], time);
      const Vector normal = (p1 - p0).cross(p2 - p0), a = at(q0, time), b = at(q1, time);
      for (const auto& p : {p0, p1, p2}) {
        const double value = view_value(p, a, b, normal);
        positive |= value > 0;
        negative |= value < 0;
        range.widen(std::abs(value));
      }
    }
    if (positive && negative) range.smallest = 0;
  }
  return range;
}

}  // namespace assay::properties
