// The coplanarity cubic and the dependencies (contact_pieces.h) of a query in integers of fixed
// width. Their Bernstein coefficients are exact up to positive constant factors.
//
// Widths. W is the number of limbs of a coordinate, and every coordinate is below 2^c in size,
// with c = bits() <= 64 W - 8. x and y are entries of two differences, s and e ends of the step.
//
//   quantity                            | below, in size                        | bits
//   x: a difference of coordinates      | 2 * 2^c                               | c + 1
//   n(s,e) = x_s y_e - x_e y_s          | 2 * 2^(2c + 2)                        | 2c + 3
//   m = n(0,1) + n(1,0)                 | 2 * 2^(2c + 3)                        | 2c + 4
//   dependencies 1..3: 2 n00, m, 2 n11  | 2 * 2^(2c + 3)                        | 2c + 4
//   dependency 0: minus their sum       | 3 * 2^(2c + 4)                        | 2c + 6
//   B0 = w0.n00, B3 = w1.n11            | 3 * 2^(3c + 4)                        | 3c + 6
//   3 B0, 3 B3                          | 9 * 2^(3c + 4)                        | 3c + 8
//   B1 = w0.m + w1.n00, B2 likewise     | 3 * 2^(3c + 5) + 3 * 2^(3c + 4)       | 3c + 8
//   a dependency, halved undivided      | 4 times as much a halving             | 2 more a halving
//   the cubic, halved undivided         | 8 times as much a halving             | 3 more a halving
//
// After max_fixed_depth = 4 halvings a dependency has at most 2c + 14 <= 128 W - 2 bits and the
// cubic 3c + 20 <= 192 W - 4: 2 W limbs hold a dependency, 3 W limbs the cubic, signs included.
#pragma once

#include "detector/contact/query_integers.h"

namespace assay::detector {

inline constexpr int max_fixed_depth = 4;
template <std::size_t W>
inline constexpr int most_bits = 64 * static_cast<int>(W) - 8;

template <class T>
using FixedQuadratic = std::array<T, 3>;
template <class T>
using FixedCubic = std::array<T, 4>;

template <std::size_t W>
class FixedProducts {
 public:
  using Coordinate = FixedInteger<W>;
  using Minor = FixedInteger<2 * W>;
  using Triple = FixedInteger<3 * W>;

  FixedProducts(const QueryIntegers& query, int first_group) : first_group_(first_group) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t end = 0; end < 2; ++end) {
        const auto origin = query.at<W>(0, end, k);
        for (std::size_t j = 0; j < 3; ++j) u_[j][end][k] = query.at<W>(j + 1, end, k) - origin;
      }
    }
    for (std::size_t k = 0; k < 3; ++k) lam1_[k] = minor(1, 2, k);
  }

  // B0, B1, B2, B3, with which the cubic's Bernstein coefficients are B0, B1/3, B2/3, B3.
  FixedCubic<Triple> coplanarity() const {
    FixedCubic<Triple> b;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto &w0 = u_[0][0][k], &w1 = u_[0][1][k];
      const auto& n = lam1_[k];
      b[0] = b[0] + w0 * n[0];
      b[1] = b[1] + w0 * n[1] + w1 * n[0];
      b[2] = b[2] + w0 * n[2] + w1 * n[1];
      b[3] = b[3] + w1 * n[2];
    }
    return b;
  }

  // L_k,0..3 of axis k, times 2.
  std::array<FixedQuadratic<Minor>, 4> dependency(std::size_t axis) const {
    std::array<FixedQuadratic<Minor>, 4> l = {
        {{}, lam1_[axis], minor(2, 0, axis), minor(0, 1, axis)}};
    for (std::size_t i = 1; i < 4; ++i) {
      l[i][0] = l[i][0] + l[i][0];
      l[i][2] = l[i][2] + l[i][2];
    }
    for (std::size_t c = 0; c < 3; ++c) l[0][c] = -(l[1][c] + l[2][c] + l[3][c]);
    for (auto i = static_cast<std::size_t>(first_group_); i < 4; ++i) {
      for (auto& c : l[i]) c = -c;
    }
    return l;
  }

 private:
  // Component `axis` of u_i x u_j: n00, m, n11.
  FixedQuadratic<Minor> minor(std::size_t i, std::size_t j, std::size_t axis) const {
    const std::size_t p = (axis + 1) % 3, q = (axis + 2) % 3;
    const auto n = [&](std::size_t s, std::size_t e) {
      return u_[i][s][p] * u_[j][e][q] - u_[i][s][q] * u_[j][e][p];
    };
    return {n(0, 0), n(0, 1) + n(1, 0), n(1, 1)};
  }

  int first_group_;
  std::array<std::array<std::array<Coordinate, 3>, 2>, 3> u_;  // point, end, axis
  std::array<FixedQuadratic<Minor>, 3> lam1_;
};

// Sets `left` and `right` to the coefficients over the two halves, times 2^(n-1), so that nothing
// is divided.
template <class T, std::size_t n>
void halve_undivided(std::array<T, n> row, std::array<T, n>& left, std::array<T, n>& right) {
  for (std::size_t level = 0; level < n; ++level) {
    const auto missing = static_cast<unsigned>(n - 1 - level);
    left[level] = row[0].shifted(missing);
    right[n - 1 - level] = row[n - 1 - level].shifted(missing);
    for (std::size_t i = 0; i + 1 + level < n; ++i) row[i] = row[i] + row[i + 1];
  }
}

}  // namespace assay::detector
