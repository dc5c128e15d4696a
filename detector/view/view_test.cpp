#include "detector/view/view_test.h"

#include "detector/view/view_exact.h"

namespace assay::detector {
namespace {

MovingTriangle moving_triangle(const Topology& mesh, std::int32_t triangle,
                               const PositionsView& x_t0, const PositionsView& x_t1) {
  const auto& v = mesh.triangles[static_cast<std::size_t>(triangle)];
  return {moving_point(x_t0, x_t1, v[0]), moving_point(x_t0, x_t1, v[1]),
          moving_point(x_t0, x_t1, v[2])};
}

}  // namespace

ViewSign view_sign(const MovingTriangle& triangle, const ViewPrimitive& primitive,
                   ViewCounts& counts) {
  if (const auto sign = filter_view_sign(triangle, primitive)) {
    ++counts.filter;
    return *sign;
  }
  ++counts.exact;
  return exact_view_sign(triangle, primitive);
}

void classify(const Topology& mesh, std::span<const std::int32_t> triangles,
              const PositionsView& x_t0, const PositionsView& x_t1, const ViewPrimitive& primitive,
              std::vector<ViewSign>& signs, ViewCounts& counts) {
  for (const auto t : triangles) {
    signs[static_cast<std::size_t>(t)] =
        view_sign(moving_triangle(mesh, t, x_t0, x_t1), primitive, counts);
  }
}

bool all_positive_at(const Topology& mesh, std::span<const std::int32_t> triangles,
                     const PositionsView& x, const Point& q0, const Point& q1) {
  const ViewPrimitive still{{q0, q0}, {q1, q1}};
  ViewCounts counts;
  for (const auto t : triangles) {
    if (view_sign(moving_triangle(mesh, t, x, x), still, counts) != ViewSign::positive)
      return false;
  }
  return true;
}

}  // namespace assay::detector
