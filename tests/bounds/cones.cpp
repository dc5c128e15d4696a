// Claims about normal cones and contours: the directions that a triangle faces, and turns and
// cosines in the plane.
#include "detector/traditional/moving_contour.cpp"
#include "tests/bounds/claims.h"
#include "tests/bounds/moving_points.h"

namespace assay::bounds {
namespace {

using namespace detector;

// In units of 2^-53 times the size of the coordinate.
constexpr double coordinate_error = 2.125;

// The plane's coordinates of a difference of two points, along the direction (2, 1, 1) or an axis.
void claim_coordinates(Claims& claims) {
  for (const int bit : {0, 42}) {
    const auto [x_t0, x_t1] = moving_vertices("p", 2);
    MovingContour contour({x_t0, x_t1});
    contour.d_ = direction(bit);
    contour.axis_ = {1, 2, 0};
    std::array<Recorded, 2> magnitude = {0, 0};
    const auto flat = contour.flat(1, 0, magnitude);
    for (std::size_t i = 0; i < 2; ++i) {
      const Recorded bound = coordinate_error * Recorded(0x1p-53) * magnitude[i];
      for (const Recorded& x : {flat.t0[i], flat.t1[i]}) believe(x, bound);
    }
    claims.write_obligations("cones-coordinate");
  }
}

MovingContour::Flat flat(int number, std::array<Recorded, 2>& magnitude) {
  MovingContour::Flat out;
  const MovingPoint p = moving_point("u", number), q = moving_point("u", number + 4);
  for (std::size_t k = 0; k < 2; ++k) {
    out.t0[k] = p.t0[k] - q.t0[k];
    out.t1[k] = p.t1[k] - q.t1[k];
    magnitude[k] = std::max({magnitude[k], abs(out.t0[k]), abs(out.t1[k])});
  }
  return out;
}

void claim_cones(Claims& claims) {
  faced_directions({moving_point("p", 0), moving_point("p", 1), moving_point("p", 2)});
  claims.write_obligations("cones-facing");
  claim_coordinates(claims);
  // From here on coordinates of the plane are entries, off by what was proved of them.
  std::array<Recorded, 2> magnitude = {0, 0};
  const auto entries = [&](std::array<Recorded, 2>& magnitude) {
    record.errors = {{"uu0", coordinate_error}, {"uu1", coordinate_error}};
    return std::array{flat(0, magnitude), flat(1, magnitude), flat(2, magnitude)};
  };
  std::array<Recorded, 2> m = {0, 0};
  const auto [a, b, c] = entries(m);
  are_apart({{turn(a, b), turn(a, c)}, {turn(b, a), turn(b, c)}}, m[0] * m[1], 0);
  claims.write_obligations("cones-turn");
  m = {0, 0};
  const auto [x, y, z] = entries(m);
  is_open(turn(x, y), cosine(x, y), m[0] * m[1], m[0] * m[0] + m[1] * m[1], 0);
  claims.write_obligations("cones-open");
}

const Filter filter("cones", claim_cones);

}  // namespace
}  // namespace assay::bounds
