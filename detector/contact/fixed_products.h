// The coplanarity cubic and the dependencies (contact_pieces.h) of a query in integers of fixed
// width. Their Bernstein coefficients are exact up to positive constant factors.
//
// Widths. W is the number of limbs of a coordinate, and every coordinate is below 2^c in size,
// with c = bits() <= 64 W - 8. x and y are entries of two differences; s and e are times, 0 or 1.
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
//   x at a time k / 16, times 16        | 16 times as much                      | c + 5
//   a dependency, halved undivided      | 4 times as much for each halving      | 2 more for each
//   the cubic, halved undivided         | 8 times as much for each halving      | 3 more for each
//
// After max_fixed_depth = 4 halvings a dependency has at most 2c + 14 <= 128 W - 2 bits and the
// cubic 3c + 20 <= 192 W - 4: 2 W limbs hold a dependency, 3 W limbs the cubic, signs included.
#pragma once

#include <bit>
#include <climits>
#include <optional>

#include "detector/exact/fixed_integer.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// The coordinates of an elementary query as integers. Each axis is multiplied by a power of two of
// its own. This is an affine map, so contacts and their times stay the same, and the integers are
// as short as they can be.
class QueryIntegers {
 public:
  explicit QueryIntegers(const FourPoints& query) {
    for (std::size_t k = 0; k < 3; ++k) {
      int least = INT_MAX, beyond = INT_MIN;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t end = 0; end < 2; ++end) {
          Coordinate& c = coordinates_[i][end][k];
          c = split(end == 0 ? query.points[i].t0[k] : query.points[i].t1[k]);
          if (c.mantissa == 0) continue;
          least = std::min(least, c.exponent + std::countr_zero(c.mantissa));
          beyond = std::max(beyond, c.exponent + static_cast<int>(std::bit_width(c.mantissa)));
        }
      }
      least_[k] = least;
      if (beyond > least) bits_ = std::max(bits_, beyond - least);
    }
  }

  // Returns the bits of the longest integer: every integer is below 2^bits() in size.
  int bits() const { return bits_; }

  // Returns coordinate k of point i at t=0 (end 0) or t=1 (end 1). REQUIRES bits() < 64 * limbs.
  template <std::size_t limbs>
  FixedInteger<limbs> at(std::size_t i, std::size_t end, std::size_t k) const {
    const Coordinate& c = coordinates_[i][end][k];
    FixedInteger<limbs> value;
    if (c.mantissa == 0) return value;
    const int shift = c.exponent - least_[k];
    if (shift <= 0) {
      value.limb(0) = c.mantissa >> -shift;
    } else {
      const auto whole = static_cast<std::size_t>(shift) / 64;
      const auto part = static_cast<unsigned>(shift) % 64;
      value.limb(whole) = c.mantissa << part;
      if (part > 0 && whole + 1 < limbs) value.limb(whole + 1) = c.mantissa >> (64 - part);
    }
    return c.negative ? -value : value;
  }

 private:
  struct Coordinate {
    std::uint64_t mantissa;
    int exponent;
    bool negative;
  };

  // Returns a finite double as its sign and mantissa times 2^exponent.
  static Coordinate split(double value) {
    const auto pattern = std::bit_cast<std::uint64_t>(value);
    constexpr unsigned fraction_bits = 52;
    constexpr int least_exponent = -1074;
    const std::uint64_t fraction = pattern & ((std::uint64_t{1} << fraction_bits) - 1);
    const auto biased = static_cast<int>(pattern >> fraction_bits & 0x7ff);
    const bool negative = pattern >> 63 != 0;
    if (biased == 0) return {fraction, least_exponent, negative};
    return {fraction | std::uint64_t{1} << fraction_bits, least_exponent + biased - 1, negative};
  }

  std::array<std::array<std::array<Coordinate, 3>, 2>, 4> coordinates_;
  std::array<int, 3> least_;
  int bits_ = 0;
};

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

  // Returns B0..B3. The cubic's Bernstein coefficients are B0, B1/3, B2/3, B3.
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

  // Returns L_k,0..3 of axis k, times 2.
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

  // Returns coordinate `axis` of x_i - x_j at t=0 (end 0) or t=1 (end 1).
  Coordinate difference(std::size_t i, std::size_t j, std::size_t end, std::size_t axis) const {
    const auto from_origin = [&](std::size_t p) {
      return p == 0 ? Coordinate() : u_[p - 1][end][axis];
    };
    return from_origin(i) - from_origin(j);
  }

 private:
  // Returns component `axis` of u_i x u_j: n00, m, n11.
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

// The rest of this file: what the signs of a polynomial's Bernstein coefficients tell (PieceSigns),
// and a piece of the step in exact coefficients (FixedPiece). Coefficients that are 0 are left out:
// - If the other coefficients have one sign, the polynomial has it throughout the open piece.
// - The number of sign changes is the number of roots in the open piece plus an even number >= 0
//   (Descartes' rule, by s/(1-s)). So with no change there is no root, and with one change there
//   is exactly one, a simple one.

// What is known of the sign of one polynomial over the open piece.
struct PieceSigns {
  int changes = 0;
  int first = 0;  // the sign just after the beginning; 0 if the polynomial vanishes throughout
  bool is_known() const { return changes == 0; }  // `first` is then the sign throughout
};

template <class T, std::size_t n>
PieceSigns piece_signs(const std::array<T, n>& coefficients) {
  PieceSigns signs;
  int last = 0;
  for (const auto& c : coefficients) {
    const int sign = c.sign();
    if (sign == 0) continue;
    if (last == 0) signs.first = sign;
    signs.changes += last != 0 && sign != last;
    last = sign;
  }
  return signs;
}

// Which of the two strict signs occur among some polynomials.
struct SignSet {
  bool positive = false, negative = false;
  void add(int sign) {
    positive |= sign > 0;
    negative |= sign < 0;
  }
  bool both() const { return positive && negative; }
  bool any() const { return positive || negative; }
};

template <std::size_t W>
struct FixedPiece {
  using Minor = typename FixedProducts<W>::Minor;
  using Triple = typename FixedProducts<W>::Triple;
  using Dependency = std::array<FixedQuadratic<Minor>, 4>;

  FixedCubic<Triple> f;
  std::array<std::optional<Dependency>, 3> dependencies;  // computed when first needed
  double lo, hi;                                          // dyadic, and so exact

  // Returns the dependency of this axis, and computes it if the piece does not have it yet. Only
  // the piece that is the whole step can lack a dependency, because halves() computes all three of
  // them.
  const Dependency& dependency(std::size_t axis, const FixedProducts<W>& products) {
    auto& l = dependencies[axis];
    if (!l) l = products.dependency(axis);
    return *l;
  }

  // Returns the two halves. REQUIRES that all dependencies have been computed.
  std::array<FixedPiece, 2> halves() const {
    std::array<FixedPiece, 2> out;
    auto& [left, right] = out;
    halve_undivided(f, left.f, right.f);
    for (std::size_t k = 0; k < 3; ++k) {
      left.dependencies[k].emplace();
      right.dependencies[k].emplace();
      for (std::size_t i = 0; i < 4; ++i) {
        halve_undivided((*dependencies[k])[i], (*left.dependencies[k])[i],
                        (*right.dependencies[k])[i]);
      }
    }
    left.lo = lo;
    right.hi = hi;
    left.hi = right.lo = (lo + hi) / 2;
    return out;
  }
};

// Returns the coefficients b0, b1, b2, b3, times 3, of the quadratic q0, q1, q2 written as a cubic.
template <std::size_t W>
FixedCubic<FixedInteger<3 * W>> raised(const FixedQuadratic<FixedInteger<2 * W>>& quadratic) {
  using Triple = FixedInteger<3 * W>;
  const Triple q0(quadratic[0]), q1(quadratic[1]), q2(quadratic[2]);
  return {q0 + q0 + q0, q0 + q1 + q1, q1 + q1 + q2, q2 + q2 + q2};
}

}  // namespace assay::detector
