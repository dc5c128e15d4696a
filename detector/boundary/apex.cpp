#include "detector/boundary/apex.h"

#include <algorithm>
#include <cmath>

namespace assay::detector {
namespace {

struct LoopBox {
  Point lo, hi;
};

LoopBox box_of(const Loop& loop, const PositionsView& x) {
  LoopBox box{point_of(x, loop[0]), point_of(x, loop[0])};
  for (const auto v : loop) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], x(v, static_cast<Eigen::Index>(k)));
      box.hi[k] = std::max(box.hi[k], x(v, static_cast<Eigen::Index>(k)));
    }
  }
  return box;
}

Point centroid(const Loop& loop, const PositionsView& x, const LoopBox& box) {
  // Each term is scaled before it is added, and the result clamped to the loop's box, so that
  // rounding cannot make it overflow.
  const double weight = 1.0 / static_cast<double>(loop.size());
  Point c = {0, 0, 0};
  for (const auto v : loop) {
    for (std::size_t k = 0; k < 3; ++k) c[k] += weight * x(v, static_cast<Eigen::Index>(k));
  }
  for (std::size_t k = 0; k < 3; ++k) c[k] = std::clamp(c[k], box.lo[k], box.hi[k]);
  return c;
}

}  // namespace

Point place_apex(const ApexRule& rule, const Loop& loop, const PositionsView& x) {
  const LoopBox box = box_of(loop, x);
  const Point c = centroid(loop, x, box);
  if (rule.height == 0) return c;
  // The normal is twice the area vector of the fan from the centroid. Its unit is the longest side
  // of the loop's box, so that products neither overflow nor vanish.
  double side = 0;
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, box.hi[k] - box.lo[k]);
  if (!(side > 0) || !std::isfinite(side)) return c;
  Point normal = {0, 0, 0};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point p = point_of(x, loop[i]), q = point_of(x, loop[(i + 1) % loop.size()]);
    Point a, b;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = (p[k] - c[k]) / side;
      b[k] = (q[k] - c[k]) / side;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t m = (k + 1) % 3, n = (k + 2) % 3;
      normal[k] += a[m] * b[n] - a[n] * b[m];
    }
  }
  double length2 = 0, diagonal2 = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double extent = (box.hi[k] - box.lo[k]) / side;
    length2 += normal[k] * normal[k];
    diagonal2 += extent * extent;
  }
  if (!(length2 > 0)) return c;
  const double reach = rule.height * side * std::sqrt(diagonal2) / std::sqrt(length2);
  Point apex;
  for (std::size_t k = 0; k < 3; ++k) {
    apex[k] = c[k] + reach * normal[k];
    if (!std::isfinite(apex[k])) return c;
  }
  return apex;
}

Positions with_apexes(const PositionsView& x, const std::vector<MovingPoint>& apexes, bool at_end) {
  Positions all(x.rows() + static_cast<Eigen::Index>(apexes.size()), 3);
  all.topRows(x.rows()) = x;
  for (std::size_t l = 0; l < apexes.size(); ++l) {
    const Point& p = at_end ? apexes[l].t1 : apexes[l].t0;
    all.row(x.rows() + static_cast<Eigen::Index>(l)) << p[0], p[1], p[2];
  }
  return all;
}

}  // namespace assay::detector
