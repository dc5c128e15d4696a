// Small vector arithmetic for generators: plain sums, so the same bytes on every machine. For the
// same reason no expression here or in the generators draws two random numbers in an order that the
// language leaves open (arguments of a call, operands of +).
#pragma once

#include <vector>

#include "detector/mesh/types.h"

namespace assay::properties {

using detector::Point;
using Points = std::vector<Point>;

inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
// 0 gives a, 1 gives b.
inline Point between(const Point& a, const Point& b, double s) { return a + s * (b - a); }

inline Point mean(const Points& points) {
  Point sum = {0, 0, 0};
  for (const auto& p : points) sum = sum + p;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

}  // namespace assay::properties
