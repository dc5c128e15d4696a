// N(t).d is a quadratic in t and lies between the least and the greatest of its Bernstein
// coefficients b_i.d: if all are positive, so is N.d over the step.
//
// Error bounds, in the notation of bernstein.h. M_k bounds coordinate k of the two edges, S_k is
// the product of the other two M, and S = S_x + S_y + S_z.
//
//   quantity            | operations               | error in u          | size
//   b_i, coordinate k   | cross, middle            | 10 S_k              | 2 S_k
//   times d_k           | exact, |d_k| <= 2        | 20 S_k              | 4 S_k
//   b_i . d             | three of these, two sums | 20 + 4 + 4 = 28 S   | 4 S
//
// facing_units = 32 covers this, errors of second order, and the rounding of S.
#include "detector/traditional/facing.h"

#include <cmath>

namespace assay::detector {
namespace {

constexpr double facing_units = 32;

// The axes through the faces, edges and corners of a cube, and those between an edge's middle and
// a face's middle. From any direction the nearest of them is at most 22 degrees away.
constexpr double axes[3][facing_axes] = {
    {1, 0, 0, 1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2},
    {0, 1, 0, 1, -1, 0, 0, 1, 1, 1, 1, -1, -1, 1, 1, -1, -1, 2, 2, -2, -2, 1, 1, -1, -1},
    {0, 0, 1, 0, 0, 1, -1, 1, -1, 1, -1, 1, -1, 2, -2, 2, -2, 1, -1, 1, -1, 1, -1, 1, -1}};

}  // namespace

Direction direction(int bit) {
  const double sign = bit % 2 ? -1 : 1;
  return {sign * axes[0][bit / 2], sign * axes[1][bit / 2], sign * axes[2][bit / 2]};
}

DirectionSet faced_directions(const std::array<MovingPoint, 3>& triangle) {
  const MovingVector e1 = difference(triangle[1], triangle[0]);
  const MovingVector e2 = difference(triangle[2], triangle[0]);
  Vector m = {0, 0, 0};
  grow(m, e1);
  grow(m, e2);
  if (!in_range(m)) return 0;
  const CrossQuadratic n = cross(e1, e2);
  const double bound = facing_units * unit_roundoff * (m[1] * m[2] + m[2] * m[0] + m[0] * m[1]);
  double least[facing_axes], greatest[facing_axes];
  for (int i = 0; i < facing_axes; ++i) {
    const auto along = [&](const Vector& b) {
      return b[0] * axes[0][i] + b[1] * axes[1][i] + b[2] * axes[2][i];
    };
    const double c0 = along(n.b0), c1 = along(n.b1), c2 = along(n.b2);
    const double lo = c0 < c1 ? c0 : c1, hi = c0 > c1 ? c0 : c1;
    least[i] = lo < c2 ? lo : c2;
    greatest[i] = hi > c2 ? hi : c2;
  }
  DirectionSet set = 0;
  for (int i = 0; i < facing_axes; ++i) {
    set |= DirectionSet{least[i] > bound} << (2 * i);
    set |= DirectionSet{greatest[i] < -bound} << (2 * i + 1);
  }
  return set;
}

int nearest_direction(DirectionSet set, const Vector& vector) {
  int nearest = std::countr_zero(set);
  double greatest = -HUGE_VAL;
  for (; set != 0; set &= set - 1) {
    const int bit = std::countr_zero(set);
    const Direction d = direction(bit);
    const double cosine = dot(d, vector) / std::sqrt(dot(d, d));
    if (cosine > greatest) {
      greatest = cosine;
      nearest = bit;
    }
  }
  return nearest;
}

}  // namespace assay::detector
