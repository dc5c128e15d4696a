// Notation: u_j = x_j - x_0 for j = 1..3, moving linearly from a_j (t=0) to c_j (t=1).
//   F = u_1 . (u_2 x u_3), a cubic: the four points are coplanar where it vanishes.
//   lam_1 = u_2 x u_3, lam_2 = u_3 x u_1, lam_3 = u_1 x u_2, lam_0 = -(lam_1 + lam_2 + lam_3);
//   component k of these is an affine dependency of the points projected along axis k.
//   L_i = lam_i for points of the first group, -lam_i for those of the second.
// At a root of F: one L_k,i > 0 and another < 0 for some axis k -> no contact; all of one sign, not
// all zero, for some axis -> contact.
//
// Error bounds (bernstein.h has the steps), all M alike, u = 2^-53:
//   lam_1..3    10u M M (cross)
//   lam_0       three of those: 30u, sums at most 4 and 6 M M rounded: 10u; 40u M M
//   F           22u S with S = 3 MxMyMz: 66u MxMyMz
//   halving     coefficients of F are at most 6 MxMyMz, those of lam_0 6 M M: 18u and 12u a level
#include "detector/contact/contact_filter.h"

#include <algorithm>

#include "detector/bernstein/bernstein.h"

namespace assay::detector {
namespace {

// 1 or -1 when all coefficients are beyond the bound on that side, else 0.
template <std::size_t n>
int sure_sign(const std::array<double, n>& b, double bound) {
  const auto [least, greatest] = std::minmax_element(b.begin(), b.end());
  return *least > bound ? 1 : *greatest < -bound ? -1 : 0;
}

int sign_beyond(double value, double bound) { return value > bound ? 1 : value < -bound ? -1 : 0; }

class Filter {
 public:
  explicit Filter(const FourPoints& query) : query_(query) {
    for (std::size_t j = 0; j < 3; ++j) {
      u_[j] = difference(query.points[j + 1], query.points[0]);
      grow(magnitude_, u_[j]);
    }
  }

  FilterResult run() {
    if (!in_range(magnitude_)) return {};
    const CrossQuadratic n = cross(u_[1], u_[2]);
    const Cubic f = triple_product(u_[0], n);
    f_scale_ = magnitude_[0] * magnitude_[1] * magnitude_[2];
    if (sure_sign(f, cubic_error(0) * f_scale_) != 0) return {FilterVerdict::no_contact};
    make_dependencies(n);
    visit({f, lam_, 0, 1}, 0);
    if (result_.verdict == FilterVerdict::contact) return result_;
    result_.verdict = all_free_ ? FilterVerdict::no_contact : FilterVerdict::unsure;
    return result_;
  }

 private:
  // lam[k][i], signs of the second group turned: L of the notation.
  using Dependencies = std::array<std::array<Quadratic, 4>, 3>;
  struct Piece {
    Cubic f;
    Dependencies lam;
    double lo, hi;
  };

  void make_dependencies(const CrossQuadratic& n23) {
    const std::array<CrossQuadratic, 3> lam = {n23, cross(u_[2], u_[0]), cross(u_[0], u_[1])};
    for (std::size_t k = 0; k < 3; ++k) {
      auto& l = lam_[k];
      for (std::size_t i = 0; i < 3; ++i) l[i + 1] = {lam[i].b0[k], lam[i].b1[k], lam[i].b2[k]};
      for (std::size_t c = 0; c < 3; ++c) l[0][c] = -(l[1][c] + l[2][c] + l[3][c]);
      for (int i = query_.first_group; i < 4; ++i) {
        for (double& c : l[static_cast<std::size_t>(i)]) c = -c;
      }
      lam_scale_[k] = magnitude_[(k + 1) % 3] * magnitude_[(k + 2) % 3];
    }
  }

  // Pieces in time order; true: stop, a contact is certain.
  bool visit(const Piece& piece, int depth) {
    const double f_bound = cubic_error(depth) * f_scale_;
    if (sure_sign(piece.f, f_bound) != 0) return false;
    const int f_lo = sign_beyond(piece.f[0], f_bound), f_hi = sign_beyond(piece.f[3], f_bound);
    const bool f_changes_sign = f_lo * f_hi < 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double bound = quadratic_error(depth) * lam_scale_[k];
      bool positive = false, negative = false, open = false;
      for (const auto& l : piece.lam[k]) {
        const int sign = sure_sign(l, bound);
        positive |= sign > 0;
        negative |= sign < 0;
        open |= sign == 0;
      }
      if (positive && negative) return false;
      if (!open && f_changes_sign) {
        report(piece, f_bound, f_lo);
        return true;
      }
    }
    if (depth == max_filter_depth) {
      all_free_ = false;
      return false;
    }
    Piece left, right;
    halve(piece.f, left.f, right.f);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 4; ++i) halve(piece.lam[k][i], left.lam[k][i], right.lam[k][i]);
    }
    left.lo = piece.lo;
    right.hi = piece.hi;
    left.hi = right.lo = (piece.lo + piece.hi) / 2;  // exact: dyadic, at most 4 bits
    return visit(left, depth + 1) || visit(right, depth + 1);
  }

  void report(const Piece& piece, double f_bound, int f_lo) {
    result_.verdict = FilterVerdict::contact;
    result_.lo = piece.lo;
    result_.hi = piece.hi;
    // One root of F only: the coefficients change sign once, wherever an uncertain one falls.
    const bool single =
        sign_beyond(piece.f[1], f_bound) == f_lo || sign_beyond(piece.f[2], f_bound) == -f_lo;
    result_.time_bracketed = all_free_ && single;
    result_.time_guess = guess(piece);
  }

  static double guess(const Piece& piece) {
    const auto& b = piece.f;
    const double c1 = 3 * (b[1] - b[0]), c2 = 3 * (b[2] - 2 * b[1] + b[0]);
    const double c3 = b[3] - 3 * b[2] + 3 * b[1] - b[0];
    double lo = 0, hi = 1, s = 0.5;
    constexpr int max_steps = 60;
    for (int i = 0; i < max_steps; ++i) {
      const double value = ((c3 * s + c2) * s + c1) * s + b[0];
      ((value > 0) == (b[0] > 0) ? lo : hi) = s;
      const double newton = s - value / ((3 * c3 * s + 2 * c2) * s + c1);
      const double next = newton > lo && newton < hi ? newton : (lo + hi) / 2;
      if (next == s) break;
      s = next;
    }
    return piece.lo + s * (piece.hi - piece.lo);
  }

  const FourPoints& query_;
  std::array<MovingVector, 3> u_;
  Vector magnitude_ = {0, 0, 0};
  Dependencies lam_;
  Vector lam_scale_ = {0, 0, 0};
  double f_scale_ = 0;
  bool all_free_ = true;  // of the pieces seen so far
  FilterResult result_;
};

}  // namespace

bool separated_along_an_axis(const FourPoints& query) {
  const int split = query.first_group;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto ordered = [&](const Point MovingPoint::*end, int& sense) {
      double lo[2], hi[2];
      for (int group = 0; group < 2; ++group) {
        const int begin = group == 0 ? 0 : split, stop = group == 0 ? split : 4;
        lo[group] = hi[group] = (query.points[static_cast<std::size_t>(begin)].*end)[k];
        for (int i = begin + 1; i < stop; ++i) {
          const double x = (query.points[static_cast<std::size_t>(i)].*end)[k];
          lo[group] = std::min(lo[group], x);
          hi[group] = std::max(hi[group], x);
        }
      }
      sense = hi[0] < lo[1] ? -1 : lo[0] > hi[1] ? 1 : 0;
      return sense != 0;
    };
    int sense_t0 = 0, sense_t1 = 0;
    if (ordered(&MovingPoint::t0, sense_t0) && ordered(&MovingPoint::t1, sense_t1) &&
        sense_t0 == sense_t1) {
      return true;
    }
  }
  return false;
}

FilterResult filter_contact(const FourPoints& query) { return Filter(query).run(); }

}  // namespace assay::detector
