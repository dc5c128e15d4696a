// The first contact in exact Bernstein coefficients over pieces of [0,1], in time order.
//
// Of a polynomial over a piece, zeros among its coefficients left out:
//   - coefficients of one sign, not all zero: that sign throughout the open piece;
//   - the number of sign changes is the number of roots in the open piece, or an even number more
//     (Descartes' rule, by s/(1-s)): none without a change, exactly one, a simple one, with one.
// So there is no uncertain sign as in contact_pieces.h; what is open are roots of the dependencies
// among those of the cubic, and roots that are close together. Ends of pieces are looked at by
// themselves: the coefficients there are the values.
#pragma once

#include <optional>

#include "detector/contact/fixed_root.h"

namespace assay::detector {

template <std::size_t W>
class FixedSearch {
 public:
  enum class Found : std::uint8_t { nothing, contact, open };

  // query.bits() <= most_bits<W>.
  FixedSearch(const QueryIntegers& query, int first_group)
      : bits_(query.bits()), products_(query, first_group), b_(products_.coplanarity()) {}

  Found run() {
    Piece whole;
    whole.f = {b_[0] + b_[0] + b_[0], b_[1], b_[2], b_[3] + b_[3] + b_[3]};
    coplanar_ = sure_signs(whole.f) == Signs{};
    whole.lo = 0;
    whole.hi = 1;
    if (coplanar_ || b_[0].is_zero()) {
      const Found at_start = look_at(whole, 0, [](const auto& l) { return l.front().sign(); });
      if (at_start != Found::nothing) return at_start;
    }
    return visit(whole, 0);
  }

  // Of the contact that was found.
  TimeEnclosure time() const {
    if (found_.lo == found_.hi) return {found_.lo, found_.hi};
    return FixedRoot<W>(b_, bits_).bracket(found_.sign_lo, found_.lo, found_.hi, found_.guess());
  }

 private:
  using Minor = typename FixedProducts<W>::Minor;
  using Triple = typename FixedProducts<W>::Triple;
  using Dependency = std::array<FixedQuadratic<Minor>, 4>;

  struct Piece {
    FixedCubic<Triple> f;
    std::array<std::optional<Dependency>, 3> dependencies;  // made when asked for
    double lo, hi;                                          // dyadic: exact
  };

  // Where there is a contact: at lo = hi, or at the one root of the cubic in the open piece.
  struct Place {
    double lo = 0, hi = 0;
    int sign_lo = 0;
    Cubic f = {};
    double guess() const { return lo + guess_root(f) * (hi - lo); }
  };

  struct Signs {
    bool positive = false, negative = false;
    void add(int sign) {
      positive |= sign > 0;
      negative |= sign < 0;
    }
    bool both() const { return positive && negative; }
    bool any() const { return positive || negative; }
    friend bool operator==(const Signs&, const Signs&) = default;
  };

  template <class T, std::size_t n>
  static Signs sure_signs(const std::array<T, n>& coefficients) {
    Signs signs;
    for (const auto& c : coefficients) signs.add(c.sign());
    return signs;
  }

  const Dependency& dependency(Piece& piece, std::size_t axis) const {
    auto& l = piece.dependencies[axis];
    if (!l) l = products_.dependency(axis);  // only the whole can lack one
    return *l;
  }

  // Whether there is a contact at an end of the piece where the points are coplanar.
  template <class SignThere>
  Found look_at(Piece& piece, double time, SignThere sign_there) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Signs signs;
      for (const auto& l : dependency(piece, axis)) signs.add(sign_there(l));
      if (signs.both()) return Found::nothing;
      if (!signs.any()) continue;
      found_ = {time, time};
      return Found::contact;
    }
    return Found::open;  // collinear
  }

  // The piece without its beginning.
  Found visit(Piece& piece, int depth) {
    int changes = 0, first = 0, last = 0;
    for (const auto& c : piece.f) {
      const int sign = c.sign();
      if (sign == 0) continue;
      if (first == 0) first = sign;
      changes += last != 0 && sign != last;
      last = sign;
    }
    if (coplanar_ || changes > 0) {
      bool apart = false;
      for (std::size_t axis = 0; axis < 3 && !apart; ++axis) {
        Signs inside;
        bool all_known = true;
        for (const auto& l : dependency(piece, axis)) {
          const Signs signs = sure_signs(l);
          if (signs.both()) {
            all_known = false;
          } else {
            inside.add(signs.positive - signs.negative);
          }
        }
        apart = inside.both();
        if (apart || !all_known || !inside.any()) continue;
        // Contact at every time of the piece would have been found at its beginning.
        if (coplanar_) return Found::open;
        if (changes > 1) continue;
        found_ = {piece.lo, piece.hi, first, {}};
        for (std::size_t i = 0; i < 4; ++i) found_.f[i] = piece.f[i].approximate(3 * bits_);
        return Found::contact;
      }
      if (!apart) return depth < max_fixed_depth ? visit_halves(piece, depth) : Found::open;
    }
    if (!coplanar_ && !piece.f.back().is_zero()) return Found::nothing;
    return look_at(piece, piece.hi, [](const auto& l) { return l.back().sign(); });
  }

  Found visit_halves(Piece& piece, int depth) {
    Piece left, right;
    halve_undivided(piece.f, left.f, right.f);
    for (std::size_t k = 0; k < 3; ++k) {
      const Dependency& l = dependency(piece, k);
      left.dependencies[k].emplace();
      right.dependencies[k].emplace();
      for (std::size_t i = 0; i < 4; ++i) {
        halve_undivided(l[i], (*left.dependencies[k])[i], (*right.dependencies[k])[i]);
      }
    }
    left.lo = piece.lo;
    right.hi = piece.hi;
    left.hi = right.lo = (piece.lo + piece.hi) / 2;
    const Found found = visit(left, depth + 1);
    return found == Found::nothing ? visit(right, depth + 1) : found;
  }

  int bits_;
  FixedProducts<W> products_;
  FixedCubic<Triple> b_;
  bool coplanar_ = false;
  Place found_;
};

}  // namespace assay::detector
