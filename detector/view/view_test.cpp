#include "detector/view/view_test.h"

#include <algorithm>

#include "detector/view/view_bounds.h"
#include "detector/view/view_exact.h"

namespace assay::detector {
namespace {

MovingTriangle moving_triangle(const Topology& mesh, std::int32_t triangle,
                               const PositionsView& x_t0, const PositionsView& x_t1) {
  const auto& v = mesh.triangles[static_cast<std::size_t>(triangle)];
  return {moving_point(x_t0, x_t1, v[0]), moving_point(x_t0, x_t1, v[1]),
          moving_point(x_t0, x_t1, v[2])};
}

// The rungs in lanes, block by block: a rung sees only what the ones before left open.
class LanePass {
 public:
  static constexpr std::size_t block_size = 512;

  LanePass(const Topology& mesh, std::span<const std::int32_t> vertices, const PositionsView& x_t0,
           const PositionsView& x_t1, const ViewPrimitive& primitive, InstructionSet set)
      : kernels_(lane_kernels(set)),
        is_point_(primitive.is_point()),
        usable_(make_lane_input(vertices, x_t0, x_t1, primitive, input_)) {
    input_.corners = mesh.triangles.front().data();
  }

  // Signs of the block's triangles that are settled; the others' numbers, and how many.
  std::size_t run(std::span<const std::int32_t> block, std::vector<ViewSign>& signs,
                  std::array<std::int32_t, block_size>& open) const {
    if (!usable_) {
      std::copy(block.begin(), block.end(), open.begin());
      return block.size();
    }
    if (is_point_) return rung(kernels_.point, block, signs, open);
    const std::size_t left = rung(kernels_.two_cubics, block, signs, open);
    return rung(kernels_.middle_piece, std::span(open).first(left), signs, open);
  }

 private:
  // `open` may hold `triangles`.
  std::size_t rung(LaneKernel kernel, std::span<const std::int32_t> triangles,
                   std::vector<ViewSign>& signs, std::array<std::int32_t, block_size>& open) const {
    std::array<std::int8_t, block_size> found;
    kernel(input_, triangles.data(), triangles.size(), found.data());
    std::size_t left = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (found[i] == lane_open) {
        open[left++] = triangles[i];
      } else {
        signs[static_cast<std::size_t>(triangles[i])] = static_cast<ViewSign>(found[i]);
      }
    }
    return left;
  }

  const LaneKernels& kernels_;
  LaneInput input_{};
  bool is_point_, usable_;
};

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

void classify(const Topology& mesh, const Component& component, const PositionsView& x_t0,
              const PositionsView& x_t1, const ViewPrimitive& primitive,
              std::vector<ViewSign>& signs, ViewCounts& counts, InstructionSet set) {
  const LanePass pass(mesh, component.vertices, x_t0, x_t1, primitive, set);
  const std::span<const std::int32_t> triangles = component.triangles;
  for (std::size_t begin = 0; begin < triangles.size(); begin += LanePass::block_size) {
    std::array<std::int32_t, LanePass::block_size> open;
    const auto block =
        triangles.subspan(begin, std::min(LanePass::block_size, triangles.size() - begin));
    const std::size_t left = pass.run(block, signs, open);
    counts.lanes += block.size() - left;
    for (const auto t : std::span(open).first(left)) {
      signs[static_cast<std::size_t>(t)] =
          view_sign(moving_triangle(mesh, t, x_t0, x_t1), primitive, counts);
    }
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
