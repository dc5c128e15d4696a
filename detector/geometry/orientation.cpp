#include "detector/geometry/orientation.h"

#include <algorithm>
#include <cmath>

#include "detector/exact/integer.h"
#include "detector/geometry/orientation_filter.h"

namespace assay::detector {
namespace {

int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const std::array<double, 12> values = {a[0], a[1], a[2], b[0], b[1], b[2],
                                         c[0], c[1], c[2], d[0], d[1], d[2]};
  std::array<Integer, 12> x;
  to_common_integers(values, x);
  std::array<std::array<Integer, 3>, 3> u;
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t k = 0; k < 3; ++k) u[j][k] = x[3 * (j + 1) + k] - x[k];
  }
  const Integer det = u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) +
                      u[0][1] * (u[1][2] * u[2][0] - u[1][0] * u[2][2]) +
                      u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
  return det.sign();
}

// Whether doubles prove that both ends of the segment are strictly on one side of the triangle's
// plane. It computes two orientations with the bound of orientation_filter.h, with M_k the largest
// |coordinate k| of all four differences.
bool surely_on_one_side(const Point& e0, const Point& e1, const std::array<Point, 3>& face) {
  double u[4][3], magnitude[3] = {0, 0, 0};
  const std::array<const Point*, 4> points = {&face[1], &face[2], &e0, &e1};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t k = 0; k < 3; ++k) {
      u[j][k] = (*points[j])[k] - face[0][k];
      magnitude[k] = std::max(magnitude[k], std::abs(u[j][k]));
    }
  }
  const bool in_range = std::all_of(magnitude, magnitude + 3, [](double m) {
    return m > least_magnitude && m < greatest_magnitude;
  });
  if (!in_range) return false;
  const double n[3] = {u[0][1] * u[1][2] - u[0][2] * u[1][1], u[0][2] * u[1][0] - u[0][0] * u[1][2],
                       u[0][0] * u[1][1] - u[0][1] * u[1][0]};
  const double side0 = u[2][0] * n[0] + u[2][1] * n[1] + u[2][2] * n[2];
  const double side1 = u[3][0] * n[0] + u[3][1] * n[1] + u[3][2] * n[2];
  const double bound =
      orientation_error<ProvedBounds> * (magnitude[0] * magnitude[1] * magnitude[2]);
  return (side0 > bound && side1 > bound) || (side0 < -bound && side1 < -bound);
}

}  // namespace

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int sign = filtered_orientation<ProvedBounds>(a, b, c, d);
  return sign != 0 ? sign : exact_orientation(a, b, c, d);
}

bool segment_pierces_triangle(const Point& e0, const Point& e1, const std::array<Point, 3>& face) {
  if (surely_on_one_side(e0, e1, face)) return false;
  const int side0 = orientation(face[0], face[1], face[2], e0);
  if (side0 == 0) return false;
  if (orientation(face[0], face[1], face[2], e1) != -side0) return false;
  const int turn = orientation(e0, e1, face[0], face[1]);
  return turn != 0 && orientation(e0, e1, face[1], face[2]) == turn &&
         orientation(e0, e1, face[2], face[0]) == turn;
}

}  // namespace assay::detector
