// Looks at four moving points over pieces of [0,1], in time order. This is the part of the
// elementary test that comes before integers, written once for every arithmetic.
//
// Notation: u_j = x_j - x_0 for j = 1..3, moving linearly from a_j (t=0) to c_j (t=1).
//   F = u_1 . (u_2 x u_3), a cubic: the four points are coplanar where it vanishes.
//   lam_1 = u_2 x u_3, lam_2 = u_3 x u_1, lam_3 = u_1 x u_2, lam_0 = -(lam_1 + lam_2 + lam_3);
//   component k of these is an affine dependency of the points projected along axis k.
//   L_i = lam_i for points of the first group, -lam_i for points of the second group.
// At a root of F there is no contact if one L_k,i > 0 and another < 0 for some axis k. There is a
// contact if for some axis all L_k,i have one sign and are not all zero.
//
// Error bounds, in the notation of bernstein.h. All u_j have the bounds M_k. Here w is u_1 and n is
// u_2 x u_3. A middle coefficient of F is made of two products w . n; in one of them n is the first
// or last coefficient of the cross product ("end").
//
//   quantity      | operations                      | error in u               | size
//   lam_1..3      | cross, middle                   | 10 MM                    | 2 MM
//   lam_0         | three of these, two sums        | 30 + 4 + 6 = 40 MM       | 6 MM
//   w . n         | three w n, sums of 4 and 6      | 42 + 4 + 6 = 52 MxMyMz   | 6 MxMyMz
//   w . n, end    | a minor has 8 u, a cross 10 u   | 36 + 4 + 6 = 46 MxMyMz   | 6 MxMyMz
//   F             | (2 (w . n) + w . n, end) / 3    | 168 / 3 + 6 = 62 MxMyMz  | 6 MxMyMz
//   lam_0 halved  | a quadratic with B = 6 MM       | as before + 12 MM        | 6 MM
//   F halved      | a cubic with B = 6 MxMyMz       | as before + 18 MxMyMz    | 6 MxMyMz
//
// quadratic_error (of lam_0) and cubic_error (of F) are these errors plus one u.
#pragma once

#include "detector/exact/bernstein.h"
#include "detector/mesh/step_types.h"

namespace assay::detector {

// M_k = largest |coordinate k of x_j(0) - x_0(0), x_j(1) - x_0(1)|. After `depth` halvings a
// computed coefficient of the cubic is off by less than cubic_error(depth) * MxMyMz, and a computed
// coefficient of a dependency by less than quadratic_error(depth) * MpMq.
template <class Bounds = ProvedBounds>
constexpr auto cubic_error(int depth) {
  return static_cast<typename Bounds::Number>(63 + 18 * depth) * Bounds::unit;
}
template <class Bounds = ProvedBounds>
constexpr auto quadratic_error(int depth) {
  return static_cast<typename Bounds::Number>(41 + 12 * depth) * Bounds::unit;
}

template <class Number>
struct ContactPiece {
  CubicOf<Number> f;
  // By axis k, the Bernstein coefficients of L_k,i. Each element holds the coefficient for the four
  // points i = 0..3 side by side.
  std::array<QuadraticOf<std::array<Number, 4>>, 3> dependencies;
  Number lo, hi;  // dyadic: exact
};

// Visits pieces of the step in time order. `Search` says what to do with a piece by three
// functions:
//
//   bool may_halve(int depth, bool ends_are_sure);
//   bool open(const Piece&);
//   void contact(const Piece&, Number f_bound, int f_lo);
//
// A piece that is certainly without a contact is passed over. A piece that the signs do not decide
// is halved if may_halve() returns true; ends_are_sure says whether the signs of F at the beginning
// and at the end of the piece are certain. If may_halve() returns false, open(piece) is called; if
// open() returns true, the search stops. contact() is called for a piece that has a root of F, if
// there is a contact at each of its roots: F has the sign f_lo at the beginning of the piece and
// the opposite sign at its end, and the coefficients of F are off by at most f_bound. After
// contact() the search stops.
template <class Bounds, class Search>
class ContactPieces {
 public:
  using Number = typename Bounds::Number;
  using Piece = ContactPiece<Number>;

  ContactPieces(const FourPoints& query, Search& search) : query_(query), search_(search) {
    make_differences();
  }

  void run() {
    const auto n = cross(u_[1], u_[2]);
    Piece whole;
    whole.f = triple_product(u_[0], n);
    f_scale_ = magnitude_[0] * magnitude_[1] * magnitude_[2];
    if (sure_sign(whole.f, cubic_error<Bounds>(0) * f_scale_) != 0) return;
    make_dependencies(n, whole);
    whole.lo = 0;
    whole.hi = 1;
    visit(whole, 0);
  }

 private:
  void make_differences() {
    for (std::size_t j = 0; j < 3; ++j) {
      u_[j] = difference<Number>(query_.points[j + 1], query_.points[0]);
      grow(magnitude_, u_[j]);
    }
    if constexpr (Bounds::proved) {
      if (!in_range(magnitude_)) bring_into_range();
    }
  }

  // Multiplies each axis by a power of two that makes 1 <= M_k < 2. This is an affine map, so
  // contacts and their times stay the same. A number that underflows is off by less than 2^-1074,
  // far below the slack of u MxMyMz in the bounds. If a difference overflows, differences of
  // halved coordinates are used.
  [[gnu::noinline]] void bring_into_range() {
    const bool overflows = !std::all_of(magnitude_.begin(), magnitude_.end(),
                                        [](Number m) { return std::isfinite(m); });
    if (overflows) {
      magnitude_ = {};
      for (std::size_t j = 0; j < 3; ++j) {
        u_[j] = difference<Number>(half(query_.points[j + 1]), half(query_.points[0]));
        grow(magnitude_, u_[j]);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (magnitude_[k] == 0) continue;
      const int exponent = std::ilogb(magnitude_[k]);
      for (auto& u : u_) {
        u.t0[k] = std::scalbn(u.t0[k], -exponent);
        u.t1[k] = std::scalbn(u.t1[k], -exponent);
      }
      magnitude_[k] = std::scalbn(magnitude_[k], -exponent);
    }
  }

  static MovingPoint half(MovingPoint p) {
    for (std::size_t k = 0; k < 3; ++k) {
      p.t0[k] /= 2;
      p.t1[k] /= 2;
    }
    return p;
  }

  void make_dependencies(const CrossQuadraticOf<Number>& n23, Piece& piece) {
    const std::array<CrossQuadraticOf<Number>, 3> lam = {n23, cross(u_[2], u_[0]),
                                                         cross(u_[0], u_[1])};
    for (std::size_t k = 0; k < 3; ++k) {
      auto& l = piece.dependencies[k];
      for (std::size_t i = 0; i < 3; ++i) {
        l[0][i + 1] = lam[i].b0[k];
        l[1][i + 1] = lam[i].b1[k];
        l[2][i + 1] = lam[i].b2[k];
      }
      for (auto& c : l) {
        c[0] = -(c[1] + c[2] + c[3]);
        for (auto i = static_cast<std::size_t>(query_.first_group); i < 4; ++i) c[i] = -c[i];
      }
      scale_[k] = magnitude_[(k + 1) % 3] * magnitude_[(k + 2) % 3];
    }
  }

  // Looks at a piece that `depth` halvings have made. Returns true if the search has to stop.
  bool visit(const Piece& piece, int depth) {
    const Number f_bound = cubic_error<Bounds>(depth) * f_scale_;
    if (sure_sign(piece.f, f_bound) != 0) return false;
    const int f_lo = sign_beyond(piece.f[0], f_bound), f_hi = sign_beyond(piece.f[3], f_bound);
    const bool f_changes_sign = f_lo * f_hi < 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Number bound = quadratic_error<Bounds>(depth) * scale_[k];
      bool positive = false, negative = false, open = false;
      const auto& l = piece.dependencies[k];
      auto least = l[0], greatest = l[0];
      for (std::size_t c = 1; c < 3; ++c) {
        for (std::size_t i = 0; i < 4; ++i) {
          least[i] = std::min(least[i], l[c][i]);
          greatest[i] = std::max(greatest[i], l[c][i]);
        }
      }
      for (std::size_t i = 0; i < 4; ++i) {
        const bool above = least[i] > bound, below = greatest[i] < -bound;
        positive |= above;
        negative |= below;
        open |= !above && !below;
      }
      if (positive && negative) return false;
      if (!open && f_changes_sign) {
        search_.contact(piece, f_bound, f_lo);
        return true;
      }
    }
    if (!search_.may_halve(depth, f_lo * f_hi != 0)) return search_.open(piece);
    Piece left, right;
    halve(piece.f, left.f, right.f);
    for (std::size_t k = 0; k < 3; ++k) {
      halve(piece.dependencies[k], left.dependencies[k], right.dependencies[k]);
    }
    left.lo = piece.lo;
    right.hi = piece.hi;
    left.hi = right.lo = (piece.lo + piece.hi) / 2;
    return visit(left, depth + 1) || visit(right, depth + 1);
  }

  const FourPoints& query_;
  Search& search_;
  std::array<MovingVectorOf<Number>, 3> u_;
  VectorOf<Number> magnitude_ = {0, 0, 0};
  VectorOf<Number> scale_ = {0, 0, 0};
  Number f_scale_ = 0;
};

// Guesses a root in [0,1] of a cubic whose values at 0 and 1 differ in sign. It makes Newton steps,
// and halves the bracket if a step would leave it. It promises no accuracy.
template <class Number>
Number guess_root(const CubicOf<Number>& b) {
  const Number c1 = 3 * (b[1] - b[0]), c2 = 3 * (b[2] - 2 * b[1] + b[0]);
  const Number c3 = b[3] - 3 * b[2] + 3 * b[1] - b[0];
  Number lo = 0, hi = 1, s = Number(0.5);
  constexpr int max_steps = 60;
  for (int i = 0; i < max_steps; ++i) {
    const Number value = ((c3 * s + c2) * s + c1) * s + b[0];
    ((value > 0) == (b[0] > 0) ? lo : hi) = s;
    const Number newton = s - value / ((3 * c3 * s + 2 * c2) * s + c1);
    const Number next = newton > lo && newton < hi ? newton : (lo + hi) / 2;
    if (next == s) break;
    s = next;
  }
  return s;
}

}  // namespace assay::detector
