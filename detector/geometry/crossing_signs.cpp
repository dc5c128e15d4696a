// Coordinates are taken 4 times as large, so that the origin o = (2 p0 + p1 + p2) / 4, a point
// inside a triangle, is exact as well.
//
// Error bounds of the filter, in the notation of bernstein.h. The determinant's entries are those
// of A = 4 (a - o); W_k is the largest |a_k - p_k| involved. V is the product of the sizes 4 W_k
// of the three entries of a term.
//
//   quantity       | operations                         | error in u               | size
//   a - p0, ...    | differences of two doubles         | 1 W                      | W
//   A_k            | 2 (a - p0) + (a - p1) + (a - p2)   | 4 + 3 + 4 = 11 W         | 4 W
//   minor          | x y - z w                          | 1 + 1 + 2 = 4 V          | 2 V
//   term           | an entry times a minor             | 4 + 2 = 6 V              | 2 V
//   determinant    | three terms, two sums              | 3 * 6 + 4 + 6 = 28 V     | 6 V
//   its entries    | 6 products of 3 entries            | 6 * 3 * 4 = 72 V         | 6 V
//
// The rows of minor, term and determinant count roundings alone. The last row adds the error of
// the determinant that comes from the errors of its entries: 11 W is taken for 16 W, so each entry
// is off by 4 u of its size 4 W. Together these are 100 u V. The code asks for 128 u V, which also
// covers errors of second order and the rounding of V. A ray's direction is exact.
//
// If the filter cannot tell a sign, exact arithmetic computes it in integers. Bounded arithmetic
// leaves the sign 0. Then the direction is given up, or the count altogether, but nothing is
// counted wrongly.
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

// A sign is 0 if doubles cannot tell it, or in plain numbers if the computed determinant is 0.
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
  // V is summed by terms, because each coordinate of the (exact) direction has its own size.
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
