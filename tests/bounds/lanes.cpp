// The view test in lanes, of points and lines, with the bounds of a whole component.
#include "detector/view/view_bounds.cpp"
#define ASSAY_LANES 2
#include "detector/view/view_lanes_kernel.h"
#include "tests/bounds/moving_points.h"
#include "tests/bounds/script.h"

namespace assay::bounds {
namespace {

using namespace detector;

void claim_lanes(Claims& claims) {
  const std::vector<std::int32_t> corners = {0, 1, 2, 0, 1, 2};
  for (const bool is_line : {false, true}) {
    Positions x_t0(3, 3), x_t1(3, 3);
    for (int v = 0; v < 3; ++v) {
      const MovingPoint p = moving_point("p", v);
      for (int k = 0; k < 3; ++k) {
        x_t0(v, k) = p.t0[static_cast<std::size_t>(k)];
        x_t1(v, k) = p.t1[static_cast<std::size_t>(k)];
      }
    }
    const MovingPoint q0 = moving_point("q", 3);
    LaneInput input{};
    make_lane_input(std::span(corners).first(3), {x_t0, x_t1},
                    {q0, is_line ? moving_point("q", 4) : q0}, input);
    input.corners = corners.data();
    const std::int32_t triangles[] = {0, 1};
    std::int8_t signs[2];
    if (!is_line) point_group(input, triangles, signs);
    if (is_line) two_cubics_group(input, triangles, signs);
    claims.write_obligations("lanes");
  }
}

const Filter filter("lanes", claim_lanes);

}  // namespace
}  // namespace assay::bounds
