// Coordinates are taken 4 times as large, so that the origin (2 p0 + p1 + p2) / 4, inside a
// triangle, is exact as well. Filter: A_k = 4 (a_k - o_k) is computed as a sum of differences
// 2 (a - p0) + (a - p1) + (a - p2), each off by u times its size, two sums rounded: off by less
// than 8u W_k + 2 * 4u W_k, W_k the largest |a_k - p_k| involved, while |A_k| <= 4 W_k. For entries
// of size 4 W with error 16 u W = 4u (4W): a determinant is off by at most 6 * 3 * 4u V (entries) +
// 30u V (arithmetic), V = product of the 4 W_k: less than 128u V.
//
// Where the filter cannot tell: exact arithmetic asks integers; bounded arithmetic leaves the sign
// 0, which gives a direction up or the count altogether, never counts wrongly.
#include "detector/geometry/crossing_signs.h"

#include <algorithm>
#include <cmath>

#include "detector/bernstein/bernstein.h"
#include "detector/exact/integer.h"

namespace assay::detector {
namespace {

constexpr double least_size = 0x1p-290, greatest_size = 0x1p290;

template <class T>
T determinant(const std::array<T, 3>& a, const std::array<T, 3>& b, const std::array<T, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

template <class T>
std::array<T, 4> determinants(const std::array<std::array<T, 3>, 3>& corners,
                              const std::array<T, 3>& r) {
  const auto& [a, b, c] = corners;
  return {determinant(a, b, r), determinant(b, c, r), determinant(c, a, r), determinant(a, b, c)};
}

CrossingSigns exact_signs(const std::array<Point, 3>& corners, const RayOrigin& o,
                          const RayDirection& r) {
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
  CrossingSigns signs{};
  const auto dets =
      determinants<Integer>(from_origin, {Integer(r[0]), Integer(r[1]), Integer(r[2])});
  for (std::size_t i = 0; i < signs.size(); ++i) signs[i] = dets[i].sign();
  return signs;
}

// 0 where doubles cannot tell, or where a plain number is 0.
template <class Bounds>
CrossingSigns filtered_signs(const std::array<Point, 3>& corners, const RayOrigin& o,
                             const RayDirection& r) {
  using Number = typename Bounds::Number;
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
  if constexpr (Bounds::proved) {
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
  constexpr Number error = 128 * Bounds::unit;
  const Number along =
      error * (w[0] * w[1] * reach[2] + w[1] * w[2] * reach[0] + w[2] * w[0] * reach[1]);
  const Number volume = error * (w[0] * w[1] * w[2]);
  return {sign_beyond(dets[0], along), sign_beyond(dets[1], along), sign_beyond(dets[2], along),
          sign_beyond(dets[3], volume)};
}

}  // namespace

CrossingSigns crossing_signs(const std::array<Point, 3>& corners, const RayOrigin& o,
                             const RayDirection& r, Arithmetic arithmetic) {
  switch (arithmetic) {
    case Arithmetic::bounded:
      return filtered_signs<ProvedBounds>(corners, o, r);
    case Arithmetic::double_precision:
      return filtered_signs<NoBounds<double>>(corners, o, r);
    case Arithmetic::single_precision:
      return filtered_signs<NoBounds<float>>(corners, o, r);
    case Arithmetic::exact:
      break;
  }
  const CrossingSigns signs = filtered_signs<ProvedBounds>(corners, o, r);
  const bool all_known =
      std::all_of(signs.begin(), signs.end(), [](int sign) { return sign != 0; });
  return all_known ? signs : exact_signs(corners, o, r);
}

}  // namespace assay::detector
