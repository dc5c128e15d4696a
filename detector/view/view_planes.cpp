#include <algorithm>
#include <cmath>

#include "detector/view/view_search.h"

namespace assay::detector {
namespace {

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Halves of the least doubles are 0 or lose a bit. So in a component that is not wider than this,
// differences are enlarged in place of being halved. They cannot overflow, wherever the component
// lies along an axis.
constexpr double greatest_tiny_span = 0x1p-500, enlarged = 0x1p600;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

ViewPlanes::ViewPlanes(const Topology& mesh, const Component& component, const PositionsView& x,
                       std::size_t most) {
  Point lo = point_of(x, component.vertices[0]), hi = lo;
  for (const auto v : component.vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], x(v, static_cast<Eigen::Index>(k)));
      hi[k] = std::max(hi[k], x(v, static_cast<Eigen::Index>(k)));
    }
  }
  // Coordinates are halved before they are subtracted, so that nothing overflows.
  double span = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    centre_[k] = 0.5 * lo[k] + 0.5 * hi[k];
    scale_ = std::max(scale_, 0.5 * hi[k] - 0.5 * lo[k]);
    span = std::max(span, hi[k] - lo[k]);
  }
  is_tiny_ = span < greatest_tiny_span;
  if (is_tiny_) scale_ = 0.5 * (enlarged * span);
  points_.reserve(component.vertices.size());
  for (const auto v : component.vertices) points_.push_back(to_unit(point_of(x, v)));
  const std::size_t count = std::min(component.triangles.size(), most);
  // If these grew by doubling they would take more memory than all other preprocessing.
  for (auto* row : {&nx_, &ny_, &nz_, &offset_}) row->reserve(count);
  corners_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = component.triangles[i * component.triangles.size() / count];
    std::array<Point, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = to_unit(point_of(x, mesh.triangles[static_cast<std::size_t>(t)][k]));
    }
    const Point n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    const double length = std::sqrt(dot(n, n));
    if (!(length > 0)) continue;  // it is positive from no place
    nx_.push_back(n[0] / length);
    ny_.push_back(n[1] / length);
    nz_.push_back(n[2] / length);
    offset_.push_back(dot(normal(nx_.size() - 1), p[0]));
    corners_.push_back(p);
  }
}

ViewPlanes ViewPlanes::thinned(std::size_t most) const {
  ViewPlanes few;
  few.centre_ = centre_;
  few.scale_ = scale_;
  few.is_tiny_ = is_tiny_;
  const std::size_t points = std::min(points_.size(), most), planes = std::min(size(), most);
  few.points_.reserve(points);
  for (std::size_t i = 0; i < points; ++i)
    few.points_.push_back(points_[i * points_.size() / points]);
  for (auto* row : {&few.nx_, &few.ny_, &few.nz_, &few.offset_}) row->reserve(planes);
  few.corners_.reserve(planes);
  for (std::size_t i = 0; i < planes; ++i) {
    const std::size_t plane = i * size() / planes;
    few.nx_.push_back(nx_[plane]);
    few.ny_.push_back(ny_[plane]);
    few.nz_.push_back(nz_[plane]);
    few.offset_.push_back(offset_[plane]);
    few.corners_.push_back(corners_[plane]);
  }
  return few;
}

Point ViewPlanes::to_unit(const Point& x) const {
  if (!(scale_ > 0)) return {0, 0, 0};
  Point y;
  for (std::size_t k = 0; k < 3; ++k) {
    y[k] = is_tiny_ ? (x[k] - centre_[k]) * enlarged / scale_
                    : (0.5 * x[k] - 0.5 * centre_[k]) / (0.5 * scale_);
  }
  return y;
}

Point ViewPlanes::middle(std::size_t plane) const {
  const auto& [a, b, c] = corners_[plane];
  return {(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3};
}

std::int64_t ViewPlanes::score(const Point& q) const {
  std::int64_t positive = 0, clear = 0, negative = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double height = offset_[i] - (nx_[i] * q[0] + ny_[i] * q[1] + nz_[i] * q[2]);
    positive += height > 0 ? 1 : 0;
    clear += height > margin ? 1 : 0;
    negative += height < 0 ? 1 : 0;
  }
  return std::max(for_positive * positive + for_margin * clear, for_negative * negative);
}

std::int64_t ViewPlanes::score(const Point& q0, const Point& q1) const {
  const Point d = minus(q1, q0);
  const double length2 = dot(d, d), base = dot(q0, d);
  std::int64_t positive = 0, clear = 0, negative = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double h0 = offset_[i] - (nx_[i] * q0[0] + ny_[i] * q0[1] + nz_[i] * q0[2]);
    const double h1 = offset_[i] - (nx_[i] * q1[0] + ny_[i] * q1[1] + nz_[i] * q1[2]);
    double least = std::min(h0, h1), greatest = std::max(h0, h1);
    if (least <= 0 && greatest >= 0 && length2 > 0) {
      double s_least = 1, s_greatest = 0;
      for (const auto& p : corners_[i]) {
        const double s = std::clamp((dot(p, d) - base) / length2, 0.0, 1.0);
        s_least = std::min(s_least, s);
        s_greatest = std::max(s_greatest, s);
      }
      const double a = h0 + s_least * (h1 - h0), b = h0 + s_greatest * (h1 - h0);
      least = std::min(a, b);
      greatest = std::max(a, b);
    }
    positive += least > 0 ? 1 : 0;
    clear += least > margin ? 1 : 0;
    negative += greatest < 0 ? 1 : 0;
  }
  const std::int64_t zero = static_cast<std::int64_t>(size()) - positive - negative;
  return std::max(for_positive * positive + for_margin * clear, for_negative * negative) +
         for_zero * zero;
}

}  // namespace assay::detector
