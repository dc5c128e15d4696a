// Sheets, ramps and spheres for the tests of the traditional scheme.
#pragma once

#include <numbers>

#include "tests/detector/points.h"
#include "tests/detector/view/revolved.h"

namespace assay::tests {

using detector::Positions, detector::Triangles;

// A sheet of n x m squares, its points placed by `place(u, v)` with u, v in [0,1].
struct Sheet {
  Triangles rows;
  Positions x;
};

template <class Place>
Sheet sheet(std::int32_t n, std::int32_t m, Place place) {
  Sheet out{squares(n, m), Positions((n + 1) * (m + 1), 3)};
  for (std::int32_t i = 0; i <= n; ++i) {
    for (std::int32_t j = 0; j <= m; ++j) {
      const Point p = place(static_cast<double>(i) / n, static_cast<double>(j) / m);
      out.x.row(i * (m + 1) + j) << p[0], p[1], p[2];
    }
  }
  return out;
}

inline Point flat(double u, double v) { return {u, v, 0}; }
// Bent over by `angle` along u.
inline auto bent(double angle) {
  return [angle](double u, double v) {
    return Point{std::sin(angle * u) / angle, v, (1 - std::cos(angle * u)) / angle};
  };
}
// Winds around the z axis, rising by `rise` over `turns`.
inline auto ramp(double turns, double rise) {
  return [=](double u, double v) {
    const double a = 2 * std::numbers::pi * turns * u, r = 1 + v;
    return Point{r * std::cos(a), r * std::sin(a), rise * u};
  };
}

// A sphere whose triangles are about as high as they are wide.
inline Sheet sphere_sheet(std::int32_t rings, double radius) {
  return {revolved(rings, 2 * rings), sphere(radius, rings, 2 * rings)};
}

}  // namespace assay::tests
