// Computes the exact sign of a 3x3 determinant of coordinate differences: first in doubles with a
// bound, and in integers if doubles cannot tell.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "detector/exact/bernstein.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// The sign of a 3x3 determinant of coordinate differences in double or float, with the bounds of a
// policy (bernstein.h).
//
// Error bound, in the notation of bernstein.h. M_k is the largest |coordinate k| of the three
// differences, and MMM is MxMyMz.
//
//   quantity      | operations                        | error in u                | size
//   minor         | x y - z w                         | 8 MM                      | 2 MM
//   term          | an entry times a minor            | 8 + 2 + 2 = 12 MMM        | 2 MMM
//   determinant   | three terms, two sums             | 36 + 4 + 6 = 46 MMM       | 6 MMM
//
// orientation_error is the error of the determinant plus 2 u, which cover errors of second order.
template <class Bounds>
inline constexpr typename Bounds::Number orientation_error = 48 * Bounds::unit;

// Returns the sign of det(b-a, c-a, d-a). With proved bounds, 0 means that the determinant is 0 or
// that its sign is not known.
template <class Bounds>
int filtered_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  using Number = typename Bounds::Number;
  const std::array<const Point*, 3> ends = {&b, &c, &d};
  Number u[3][3], magnitude[3] = {0, 0, 0};
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t k = 0; k < 3; ++k) {
      u[j][k] = static_cast<Number>((*ends[j])[k]) - static_cast<Number>(a[k]);
      magnitude[k] = std::max(magnitude[k], std::abs(u[j][k]));
    }
  }
  if constexpr (Bounds::proved) {
    const bool in_range = std::all_of(magnitude, magnitude + 3, [](Number m) {
      return m > least_magnitude && m < greatest_magnitude;
    });
    if (!in_range) return 0;
  }
  const Number det = u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) +
                     u[0][1] * (u[1][2] * u[2][0] - u[1][0] * u[2][2]) +
                     u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
  return sign_beyond(det, orientation_error<Bounds> * (magnitude[0] * magnitude[1] * magnitude[2]));
}

// Returns the sign of det(b-a, c-a, d-a): 1 if a, b, c, d are oriented like 0, e_x, e_y, e_z. Exact
// for all finite inputs. 10 ns; 1 us if the determinant is near zero.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

// Error bound of sure_side. Let p and q be the two axes other than `axis`, and M_p and M_q the
// largest |difference| along p and q. In the projection, (b-a) x (c-a) is one minor, off by 8 u M_p
// M_q (bernstein.h). side_error is this error plus one u.
inline constexpr double side_error = 9 * unit_roundoff;

// Returns the sign of a minor, or 0 if its sign is not certain.
inline int sure_sign_of_minor(double minor, double m_p, double m_q) {
  if (!(m_p > least_magnitude && m_p < greatest_magnitude) ||
      !(m_q > least_magnitude && m_q < greatest_magnitude)) {
    return 0;
  }
  return sign_beyond(minor, side_error * m_p * m_q);
}

// Returns the sign of (b-a) x (c-a) in the projection along `axis`, or 0 if the sign is not
// certain.
inline int sure_side(const Point& a, const Point& b, const Point& c, std::size_t axis) {
  const std::size_t p = (axis + 1) % 3, q = (axis + 2) % 3;
  const double bp = b[p] - a[p], bq = b[q] - a[q], cp = c[p] - a[p], cq = c[q] - a[q];
  return sure_sign_of_minor(bp * cq - bq * cp, std::max(std::abs(bp), std::abs(cp)),
                            std::max(std::abs(bq), std::abs(cq)));
}

// Returns the normal (b-a) x (c-a), and sets sides[k] to sure_side(a, b, c, k).
inline Vector normal_and_sides(const Point& a, const Point& b, const Point& c,
                               std::array<int, 3>& sides) {
  const Vector p = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
               q = {c[0] - a[0], c[1] - a[1], c[2] - a[2]}, normal = cross(p, q);
  const auto most = [&](std::size_t k) { return std::max(std::abs(p[k]), std::abs(q[k])); };
  const double x = most(0), y = most(1), z = most(2);
  sides = {sure_sign_of_minor(normal[0], y, z), sure_sign_of_minor(normal[1], z, x),
           sure_sign_of_minor(normal[2], x, y)};
  return normal;
}

// Returns whether the open segment e0e1 strictly pierces the open triangle at an instant: e0 and e1
// are strictly on opposite sides of the triangle's plane, and the line e0e1 passes strictly inside
// the three edges. Exact for all finite inputs.
bool segment_pierces_triangle(const Point& e0, const Point& e1, const std::array<Point, 3>& face);

// Decides in doubles with proved bounds whether a segment strictly pierces a triangle at an
// instant.
//
// `no` and `yes` are never wrong, and `open` means that doubles cannot tell. 40 ns, no allocation.
Decision bounded_piercing(const Point& e0, const Point& e1, const std::array<Point, 3>& face);

// Does the same in plain doubles or floats (Number), without bounds. It promises nothing.
template <class Number>
bool plain_piercing(const Point& e0, const Point& e1, const std::array<Point, 3>& face);

}  // namespace assay::detector
