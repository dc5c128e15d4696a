// Along a ray the winding number drops by 1 across a triangle in the direction of its normal and
// is 0 at the end: w(origin) is the sum, over the triangles crossed, of the sign of ray . normal.
// With A, B, C the corners less the origin and r the direction, the line crosses the triangle's
// inside where det(A,B,r), det(B,C,r), det(C,A,r) have one strict sign, which is then that of
// r . normal (their sum); the crossing is ahead of the origin when det(A,B,C) has that sign too.
// A direction that meets an edge or a corner is given up for the next one.
//
// Coordinates are taken 4 times as large, so that the origin (2 p0 + p1 + p2) / 4, inside a
// triangle, is exact as well. Filter: A_k = 4 (a_k - o_k) is computed as a sum of differences
// 2 (a - p0) + (a - p1) + (a - p2), each off by u times its size, two sums rounded: off by less
// than 8u W_k + 2 * 4u W_k, W_k the largest |a_k - p_k| involved, while |A_k| <= 4 W_k. For entries
// of size 4 W with error 16 u W = 4u (4W): a determinant is off by at most 6 * 3 * 4u V (entries) +
// 30u V (arithmetic), V = product of the 4 W_k: less than 128u V.
//
// Where the filter cannot tell: exact arithmetic asks integers; bounded arithmetic leaves the sign
// 0, which gives a direction up or the count altogether, never counts wrongly.
#include "detector/state/winding.h"

#include <algorithm>
#include <cmath>

#include "detector/bernstein/bernstein.h"
#include "detector/exact/integer.h"

namespace assay::detector {
namespace {

constexpr double least_size = 0x1p-290, greatest_size = 0x1p290;

using Origin = std::array<Point, 3>;  // (2 o[0] + o[1] + o[2]) / 4
using Direction = std::array<int, 3>;

// Directions from a fixed recurrence: the same on every machine, never parallel to many edges.
Direction direction_number(int n) {
  std::uint32_t state = 0x9e3779b9u * static_cast<std::uint32_t>(n + 1);
  Direction r{};
  for (int& component : r) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    constexpr int reach = 1000;
    component = static_cast<int>(state % (2 * reach + 1)) - reach;
  }
  return r;
}

template <class T>
T determinant(const std::array<T, 3>& a, const std::array<T, 3>& b, const std::array<T, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Signs of det(A,B,r), det(B,C,r), det(C,A,r), det(A,B,C).
using Signs = std::array<int, 4>;

template <class T>
std::array<T, 4> determinants(const std::array<std::array<T, 3>, 3>& corners,
                              const std::array<T, 3>& r) {
  const auto& [a, b, c] = corners;
  return {determinant(a, b, r), determinant(b, c, r), determinant(c, a, r), determinant(a, b, c)};
}

Signs exact_signs(const std::array<Point, 3>& corners, const Origin& o, const Direction& r) {
  std::array<double, 18> values;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      values[3 * i + k] = corners[i][k];
      values[9 + 3 * i + k] = o[i][k];
    }
  }
  std::array<Integer, 18> x;
  to_common_integers(values, x);
  std::array<std::array<Integer, 3>, 3> from_origin;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      from_origin[i][k] = 4 * x[3 * i + k] - 2 * x[9 + k] - x[12 + k] - x[15 + k];
    }
  }
  Signs signs{};
  const auto dets =
      determinants<Integer>(from_origin, {Integer(r[0]), Integer(r[1]), Integer(r[2])});
  for (std::size_t i = 0; i < signs.size(); ++i) signs[i] = dets[i].sign();
  return signs;
}

// 0 where doubles cannot tell, or where a plain number is 0.
template <class Rounding>
Signs filtered_signs(const std::array<Point, 3>& corners, const Origin& o, const Direction& r) {
  using Number = typename Rounding::Number;
  std::array<VectorOf<Number>, 3> a{};
  VectorOf<Number> w = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = static_cast<Number>(corners[i][k]);
      const Number d0 = x - static_cast<Number>(o[0][k]), d1 = x - static_cast<Number>(o[1][k]),
                   d2 = x - static_cast<Number>(o[2][k]);
      a[i][k] = 2 * d0 + d1 + d2;
      w[k] = std::max({w[k], 4 * std::abs(d0), 4 * std::abs(d1), 4 * std::abs(d2)});
    }
  }
  if constexpr (Rounding::proved) {
    const bool in_range = std::all_of(w.begin(), w.end(),
                                      [](Number m) { return m > least_size && m < greatest_size; });
    if (!in_range) return {};
  }
  const VectorOf<Number> direction = {static_cast<Number>(r[0]), static_cast<Number>(r[1]),
                                      static_cast<Number>(r[2])};
  const VectorOf<Number> reach = {std::abs(direction[0]), std::abs(direction[1]),
                                  std::abs(direction[2])};
  const auto dets = determinants<Number>(a, direction);
  // The direction is exact and each of its coordinates has its own size: V by terms.
  constexpr Number error = 128 * Rounding::unit;
  const Number along =
      error * (w[0] * w[1] * reach[2] + w[1] * w[2] * reach[0] + w[2] * w[0] * reach[1]);
  const Number volume = error * (w[0] * w[1] * w[2]);
  return {sign_beyond(dets[0], along), sign_beyond(dets[1], along), sign_beyond(dets[2], along),
          sign_beyond(dets[3], volume)};
}

// What differs by arithmetic. zero_area: sure that the triangle is a segment or a point.
struct ExactSigns {
  static constexpr int max_directions = 100;
  static Signs of(const std::array<Point, 3>& corners, const Origin& o, const Direction& r) {
    const Signs signs = filtered_signs<ProvedBounds>(corners, o, r);
    const bool all_known =
        std::all_of(signs.begin(), signs.end(), [](int sign) { return sign != 0; });
    return all_known ? signs : exact_signs(corners, o, r);
  }
  static bool zero_area(const Topology& mesh, const PositionsView& x, std::int32_t triangle) {
    return has_zero_area(mesh, x, triangle);
  }
};

template <class Rounding>
struct FilteredSigns {
  static constexpr int max_directions = 16;
  static Signs of(const std::array<Point, 3>& corners, const Origin& o, const Direction& r) {
    return filtered_signs<Rounding>(corners, o, r);
  }
  static bool zero_area(const Topology& mesh, const PositionsView& x, std::int32_t triangle) {
    return has_equal_corners(mesh, x, triangle);
  }
};

enum class RayOutcome { counted, bad_direction, on_surface };

template <class SignRule>
RayOutcome count_along(const Topology& mesh, std::span<const std::int32_t> triangles,
                       const PositionsView& x, const Origin& origin, const Direction& r,
                       std::int32_t skipped, int& winding) {
  winding = 0;
  for (const auto t : triangles) {
    if (t == skipped) continue;
    const auto& v = mesh.triangles[static_cast<std::size_t>(t)];
    const Signs s =
        SignRule::of({point_of(x, v[0]), point_of(x, v[1]), point_of(x, v[2])}, origin, r);
    const bool some_positive = s[0] > 0 || s[1] > 0 || s[2] > 0;
    const bool some_negative = s[0] < 0 || s[1] < 0 || s[2] < 0;
    if (some_positive && some_negative) continue;  // the line passes by
    const bool all_zero = s[0] == 0 && s[1] == 0 && s[2] == 0;
    // Nothing is crossed there; where the line meets what is left of it, it meets an edge of a
    // neighbour too, which gives the direction up. A point would give up every direction.
    if (all_zero && SignRule::zero_area(mesh, x, t)) continue;
    const bool strictly_inside = s[0] != 0 && s[1] != 0 && s[2] != 0;
    if (!strictly_inside) return RayOutcome::bad_direction;
    if (s[3] == 0) return RayOutcome::on_surface;
    if (s[3] == s[0]) winding += s[0];
  }
  return RayOutcome::counted;
}

template <class SignRule>
std::optional<int> count_crossings(const Topology& mesh, std::span<const std::int32_t> triangles,
                                   const PositionsView& x, const Origin& origin, int outward_of) {
  for (int n = 0; n < SignRule::max_directions; ++n) {
    Direction r = direction_number(n);
    int skipped = -1;
    if (outward_of >= 0) {
      // Only rays that leave strictly on the side of the normal count the layer outside; the
      // triangle's own corners give r . normal as the sum of the three (equal) signs.
      const auto& v = mesh.triangles[static_cast<std::size_t>(outward_of)];
      const Signs s =
          SignRule::of({point_of(x, v[0]), point_of(x, v[1]), point_of(x, v[2])}, origin, r);
      if (s[0] == 0 || s[0] != s[1] || s[1] != s[2]) continue;
      if (s[0] < 0) r = {-r[0], -r[1], -r[2]};
      skipped = outward_of;
    }
    int winding = 0;
    const RayOutcome outcome =
        count_along<SignRule>(mesh, triangles, x, origin, r, skipped, winding);
    if (outcome == RayOutcome::counted) return winding;
    if (outcome == RayOutcome::on_surface) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<int> count_crossings(const Topology& mesh, std::span<const std::int32_t> triangles,
                                   const PositionsView& x, const Origin& origin, int outward_of,
                                   Arithmetic arithmetic) {
  switch (arithmetic) {
    case Arithmetic::bounded:
      return count_crossings<FilteredSigns<ProvedBounds>>(mesh, triangles, x, origin, outward_of);
    case Arithmetic::double_precision:
      return count_crossings<FilteredSigns<NoBounds<double>>>(mesh, triangles, x, origin,
                                                              outward_of);
    case Arithmetic::single_precision:
      return count_crossings<FilteredSigns<NoBounds<float>>>(mesh, triangles, x, origin,
                                                             outward_of);
    case Arithmetic::exact:
      break;
  }
  return count_crossings<ExactSigns>(mesh, triangles, x, origin, outward_of);
}

}  // namespace

bool has_zero_area(const Topology& mesh, const PositionsView& x, std::int32_t triangle) {
  const auto& v = mesh.triangles[static_cast<std::size_t>(triangle)];
  std::array<double, 9> values;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) values[3 * i + k] = x(v[i], static_cast<Eigen::Index>(k));
  }
  std::array<Integer, 9> p;
  to_common_integers(values, p);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Integer normal =
        (p[3 + i] - p[i]) * (p[6 + j] - p[j]) - (p[3 + j] - p[j]) * (p[6 + i] - p[i]);
    if (!normal.is_zero()) return false;
  }
  return true;
}

bool has_equal_corners(const Topology& mesh, const PositionsView& x, std::int32_t triangle) {
  const auto& v = mesh.triangles[static_cast<std::size_t>(triangle)];
  const Point a = point_of(x, v[0]), b = point_of(x, v[1]), c = point_of(x, v[2]);
  return a == b || b == c || c == a;
}

std::optional<int> winding_number(const Topology& mesh, std::span<const std::int32_t> triangles,
                                  const PositionsView& x, const Point& point,
                                  Arithmetic arithmetic) {
  return count_crossings(mesh, triangles, x, {point, point, point}, -1, arithmetic);
}

std::optional<int> winding_number_outside(const Topology& mesh,
                                          std::span<const std::int32_t> triangles,
                                          const PositionsView& x, std::int32_t triangle,
                                          Arithmetic arithmetic) {
  const auto& v = mesh.triangles[static_cast<std::size_t>(triangle)];
  return count_crossings(mesh, triangles, x,
                         {point_of(x, v[0]), point_of(x, v[1]), point_of(x, v[2])}, triangle,
                         arithmetic);
}

}  // namespace assay::detector
