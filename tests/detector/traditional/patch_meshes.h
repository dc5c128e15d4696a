// Sheets, ramps and spheres for the tests of the traditional scheme.
#pragma once

#include <numbers>

#include "tests/detector/points.h"

namespace assay::tests {

using detector::Positions, detector::Triangles;

// A sheet of n x m squares. `place(u, v)` returns the place of a point, with u and v in [0,1].
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
// A sheet that is bent by `angle` along u.
inline auto bent(double angle) {
  return [angle](double u, double v) {
    return Point{std::sin(angle * u) / angle, v, (1 - std::cos(angle * u)) / angle};
  };
}
// A sheet that winds around the z axis `turns` times and rises by `rise`.
inline auto ramp(double turns, double rise) {
  return [=](double u, double v) {
    const double a = 2 * std::numbers::pi * turns * u, r = 1 + v;
    return Point{r * std::cos(a), r * std::sin(a), rise * u};
  };
}

// Returns a closed sphere of `n` rings of triangles. The poles are the first and the last vertex;
// the vertices of ring i begin at 1 + (i - 1) 2n.
inline Sheet sphere(std::int32_t n, double radius) {
  const std::int32_t around = 2 * n, last = 1 + (n - 1) * around;
  Sheet out;
  out.x.resize(last + 1, 3);
  std::vector<Corners> rows;
  const auto vertex = [&](std::int32_t i, std::int32_t j) {
    return i == 0 ? 0 : i == n ? last : 1 + (i - 1) * around + j % around;
  };
  for (std::int32_t i = 0; i <= n; ++i) {
    const double a = std::numbers::pi * i / n;
    for (std::int32_t j = 0; j < around; ++j) {
      const double b = 2 * std::numbers::pi * j / around;
      out.x.row(vertex(i, j)) << radius * std::sin(a) * std::cos(b),
          radius * std::sin(a) * std::sin(b), radius * std::cos(a);
      if (i > 0 && i < n) rows.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
      if (i > 0 && i < n) rows.push_back({vertex(i, j), vertex(i, j + 1), vertex(i - 1, j + 1)});
    }
  }
  out.rows = triangles(rows);
  return out;
}

}  // namespace assay::tests
