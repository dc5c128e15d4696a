#include "detector/search/bounding_volume_tree.h"

#include <algorithm>
#include <numeric>

namespace assay::detector {
namespace {

Box join(const Box& a, const Box& b) {
  Box joined;
  for (int k = 0; k < 3; ++k) {
    joined.lo[k] = std::min(a.lo[k], b.lo[k]);
    joined.hi[k] = std::max(a.hi[k], b.hi[k]);
  }
  return joined;
}

}  // namespace

Box swept_box(const std::array<std::int32_t, 3>& vertices, const PositionsView& x_t0,
              const PositionsView& x_t1) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    double lo = x_t0(vertices[0], k), hi = lo;
    for (const auto v : vertices) {
      for (const double value : {x_t0(v, k), x_t1(v, k)}) {
        lo = std::min(lo, value);
        hi = std::max(hi, value);
      }
    }
    box.lo[k] = lo;
    box.hi[k] = hi;
  }
  return box;
}

BoundingVolumeTree::BoundingVolumeTree(const Topology& mesh, const PositionsView& x) {
  const std::size_t count = mesh.triangles.size();
  std::vector<Point> centres(count);
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      // A quarter of each corner: only the order matters, and the sum cannot overflow.
      double sum = 0;
      for (const auto v : mesh.triangles[t]) sum += 0.25 * x(v, static_cast<Eigen::Index>(k));
      centres[t][k] = sum;
    }
  }
  std::vector<std::int32_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  triangle_.reserve(2 * count - 1);
  right_.reserve(2 * count - 1);
  build(order, centres, 0, count);
  boxes_.resize(triangle_.size());
}

std::int32_t BoundingVolumeTree::build(std::vector<std::int32_t>& order,
                                       const std::vector<Point>& centres, std::size_t begin,
                                       std::size_t end) {
  const auto node = static_cast<std::int32_t>(triangle_.size());
  triangle_.push_back(end - begin == 1 ? order[begin] : -1);
  right_.push_back(-1);
  if (end - begin == 1) return node;
  const auto centre = [&](std::size_t i) -> const Point& {
    return centres[static_cast<std::size_t>(order[i])];
  };
  Point lo = centre(begin), hi = lo;
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], centre(i)[k]);
      hi[k] = std::max(hi[k], centre(i)[k]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (hi[k] - lo[k] > hi[axis] - lo[axis]) axis = k;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const auto first = order.begin();
  std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
                   first + static_cast<std::ptrdiff_t>(middle),
                   first + static_cast<std::ptrdiff_t>(end), [&](std::int32_t a, std::int32_t b) {
                     const double x = centres[static_cast<std::size_t>(a)][axis];
                     const double y = centres[static_cast<std::size_t>(b)][axis];
                     return x != y ? x < y : a < b;
                   });
  build(order, centres, begin, middle);
  right_[static_cast<std::size_t>(node)] = build(order, centres, middle, end);
  return node;
}

void BoundingVolumeTree::refit(const Topology& mesh, const PositionsView& x_t0,
                               const PositionsView& x_t1) {
  for (std::size_t n = triangle_.size(); n-- > 0;) {
    boxes_[n] = triangle_[n] >= 0
                    ? swept_box(mesh.triangles[static_cast<std::size_t>(triangle_[n])], x_t0, x_t1)
                    : join(boxes_[n + 1], boxes_[static_cast<std::size_t>(right_[n])]);
  }
}

}  // namespace assay::detector
