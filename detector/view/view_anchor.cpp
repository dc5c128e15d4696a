#include "detector/view/view_anchor.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace assay::detector {
namespace {

Point mean(const std::vector<std::int32_t>& vertices, const PositionsView& x) {
  // Scaled before the sum and kept among the values, so that rounding cannot make it overflow.
  const double weight = 1.0 / static_cast<double>(vertices.size());
  Point sum = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    double lo = x(vertices[0], axis), hi = lo;
    for (const auto v : vertices) {
      sum[k] += weight * x(v, axis);
      lo = std::min(lo, x(v, axis));
      hi = std::max(hi, x(v, axis));
    }
    sum[k] = std::clamp(sum[k], lo, hi);
  }
  return sum;
}

Eigen::Vector3d longest_axis(const std::vector<std::int32_t>& vertices, const PositionsView& x) {
  const Point centre = mean(vertices, x);
  // Divided by the extent, so that squares neither overflow nor vanish.
  double extent = 0;
  for (const auto v : vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      extent = std::max(extent, std::abs(x(v, static_cast<Eigen::Index>(k)) - centre[k]));
    }
  }
  if (!(extent > 0)) return Eigen::Vector3d::UnitX();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto v : vertices) {
    const Eigen::Vector3d offset =
        (x.row(v).transpose() - Eigen::Vector3d(centre[0], centre[1], centre[2])) / extent;
    covariance += offset * offset.transpose();
  }
  if (!covariance.allFinite()) return Eigen::Vector3d::UnitX();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(2);
}

}  // namespace

ViewAnchor make_view_anchor(ViewKind kind, const Component& component, const PositionsView& x) {
  ViewAnchor anchor{kind, component.vertices, {}};
  if (kind == ViewKind::point) return anchor;
  const Eigen::Vector3d axis = longest_axis(component.vertices, x);
  std::vector<std::pair<double, std::int32_t>> along;
  along.reserve(component.vertices.size());
  // A quarter of each, so that the sum cannot overflow.
  for (const auto v : component.vertices) along.emplace_back((0.25 * x.row(v)).dot(axis), v);
  std::sort(along.begin(), along.end());
  const std::size_t third = std::max<std::size_t>(1, along.size() / 3);
  for (std::size_t i = 0; i < third; ++i) {
    anchor.outer_vertices[0].push_back(along[i].second);
    anchor.outer_vertices[1].push_back(along[along.size() - 1 - i].second);
  }
  for (auto& outer : anchor.outer_vertices) std::sort(outer.begin(), outer.end());
  return anchor;
}

namespace {

Point end_of_line(const ViewAnchor& anchor, int end, const PositionsView& x) {
  constexpr double outer_weight = 0.75;
  const Point outer = mean(anchor.outer_vertices[end], x), all = mean(anchor.vertices, x);
  Point q;
  for (std::size_t k = 0; k < 3; ++k) q[k] = outer_weight * outer[k] + (1 - outer_weight) * all[k];
  return q;
}

}  // namespace

ViewPrimitive place_view(const ViewAnchor& anchor, const PositionsView& x_t0,
                         const PositionsView& x_t1) {
  if (anchor.kind == ViewKind::point) {
    const MovingPoint q = {mean(anchor.vertices, x_t0), mean(anchor.vertices, x_t1)};
    return {q, q};
  }
  return {{end_of_line(anchor, 0, x_t0), end_of_line(anchor, 0, x_t1)},
          {end_of_line(anchor, 1, x_t0), end_of_line(anchor, 1, x_t1)}};
}

}  // namespace assay::detector
