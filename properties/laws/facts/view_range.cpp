#include "properties/laws/facts/view_range.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "properties/numbering.h"

namespace assay::properties {
namespace {

using detector::MovingPoint;
using Vector = Eigen::Vector3d;

Vector at(const MovingPoint& p, double t) {
  const Vector from(p.t0[0], p.t0[1], p.t0[2]), to(p.t1[0], p.t1[1], p.t1[2]);
  return (1 - t) * from + t * to;
}

// (x - n(x)).N, times the constant |d|^2 if the primitive is a segment. This is the clamp form of
// L1.
double view_value(const Vector& x, const Vector& q0, const Vector& q1, const Vector& normal) {
  const Vector along = q1 - q0;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp((x - q0).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (x - q0 - share * along).dot(normal);
}

double greatest(const detector::PositionsView& x) {
  return x.rows() == 0 ? 0 : x.cwiseAbs().maxCoeff();
}

}  // namespace

ValueRange view_range(const detector::Topology& surface, std::span<const std::int32_t> triangles,
                      const detector::SteppedMesh& motion,
                      const detector::ViewPrimitive& primitive) {
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
