#include <cassert>

#include "detector/contact/fixed_products.h"
#include "detector/contact/fixed_root.h"
#include "detector/contact/rungs.h"

namespace assay::detector {
namespace {

// Finds the first contact by exact Bernstein coefficients over pieces of [0,1], in time order. All
// signs are exact here; in contact_pieces.h, which works in doubles, some are uncertain.
//
// The cubic is the coplanarity of the four points over time. The dependencies of an axis are four
// quadratics: the coefficients of the one linear dependency of the four points, once they are
// projected along that axis (contact_pieces.h). When the points are coplanar, they meet unless the
// dependencies of some axis have both strict signs.
//
// The ends of a piece are looked at by themselves, because the first and the last coefficient have
// the signs of the values there. Inside a piece, known signs may decide: both strict signs along
// one axis mean no contact. Otherwise a contact is decided if the cubic has only one root there
// and each dependency at most one. SignAtRoot then says which sign the dependency has at the root
// of the cubic. A question that is still undecided when a piece is max_fixed_depth halvings deep
// stays open: roots that are close together, and double roots inside a piece. Where all
// dependencies vanish the points are collinear, and their differences along an axis decide.
//
// Points that are coplanar throughout have no cubic. Suppose that there is no contact where the
// piece begins. Then each axis whose dependencies do not all vanish identically has both strict
// signs just after that, and at the first contact it has them no longer. Hence one of its
// dependencies vanishes at that time, so the roots of the dependencies of one such axis are all
// that has to be tried.
template <std::size_t W>
class FixedSearch {
 public:
  // W is the number of 64-bit words of the integers. first_group is the number of points of the
  // first primitive: 1 for vertex-face, 2 for edge-edge. REQUIRES query.bits() <= most_bits<W>.
  FixedSearch(const QueryIntegers& query, int first_group, Want want)
      : bits_(query.bits()),
        first_group_(static_cast<std::size_t>(first_group)),
        want_(want),
        products_(query, first_group),
        b_(products_.coplanarity()) {}

  // Decides the query. Is called once.
  Decision run() {
    Piece whole;
    whole.f = {b_[0] + b_[0] + b_[0], b_[1], b_[2], b_[3] + b_[3] + b_[3]};
    coplanar_ = piece_signs(whole.f).first == 0;
    whole.lo = 0;
    whole.hi = 1;
    if (coplanar_ || b_[0].is_zero()) {
      const Decision at_start = look_at(whole, 0, [](const auto& l) { return l.front().sign(); });
      if (at_start != Decision::no) return at_start;
    }
    return visit(whole, 0);
  }

  // Returns the time of the contact. Meaningful only if run() said yes and a time was wanted.
  const TimeEnclosure& time() const { return time_; }

 private:
  using Piece = FixedPiece<W>;
  using Triple = typename Piece::Triple;

  // Returns whether there is a contact at `time`, an end of the piece. REQUIRES that the points are
  // coplanar then.
  template <class SignThere>
  Decision look_at(Piece& piece, double time, SignThere sign_there) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      SignSet signs;
      for (const auto& l : piece.dependency(axis, products_)) signs.add(sign_there(l));
      if (signs.both()) return Decision::no;
      if (!signs.any()) continue;
      time_ = {time, time};
      return Decision::yes;
    }
    time_ = {time, time};
    const bool meet = meet_on_line([&](const Ends& d) { return value_at(time, d).sign(); });
    return meet ? Decision::yes : Decision::no;
  }

  // Returns whether there is a contact where the points are collinear: along the first axis on
  // which they differ, the groups have to overlap or touch.
  template <class SignThere>
  bool meet_on_line(SignThere sign_there) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      SignSet signs;
      bool coincide = false;
      for_each_difference(axis, [&](const Ends& d) {
        const int sign = sign_there(d);
        signs.add(sign);
        coincide |= sign == 0;
      });
      if (signs.any()) return coincide || signs.both();
    }
    return true;
  }

  // Looks for a contact in the piece without its beginning.
  Decision visit(Piece& piece, int depth) {
    const PieceSigns f = piece_signs(piece.f);
    if (coplanar_ || f.changes > 0) {
      const Decision inside = coplanar_ ? look_inside_coplanar(piece) : look_inside(piece, f);
      if (inside == Decision::open && depth < max_fixed_depth) {
        // halves() needs all dependencies. The piece keeps those that it has computed already.
        for (std::size_t k = 0; k < 3; ++k) piece.dependency(k, products_);
        for (Piece& half : piece.halves()) {
          const Decision found = visit(half, depth + 1);
          if (found != Decision::no) return found;
        }
        return Decision::no;
      }
      if (inside != Decision::no) return inside;
    }
    if (!coplanar_ && !piece.f.back().is_zero()) return Decision::no;
    return look_at(piece, piece.hi, [](const auto& l) { return l.back().sign(); });
  }

  // Looks for a contact in the open piece.
  Decision look_inside(Piece& piece, PieceSigns f) {
    const bool single = f.changes == 1;
    Decision found = look_at_signs(piece, single);
    if (found == Decision::open && single) found = look_at_root(piece, piece.f, f.first);
    if (found == Decision::yes && want_ == Want::first_time) {
      time_ = bracket(piece, b_, piece.f, f.first);
    }
    return found;
  }

  Decision look_inside_coplanar(Piece& piece) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& dependency = piece.dependency(axis, products_);
      bool vanishes = true;
      for (const auto& l : dependency) vanishes &= piece_signs(l).first == 0;
      if (!vanishes) {
        const Decision found = look_at_signs(piece, false);
        return found == Decision::open ? look_at_changes(piece, axis) : found;
      }
    }
    return look_at_collinear(piece);
  }

  // Decides for points that are collinear throughout. If they are apart at t=0 they meet first
  // where a difference along an axis vanishes, at p = d_0 / (d_0 - d_1) with its values at the two
  // ends. A difference e has the sign of (d_0 e_1 - d_1 e_0) / (d_0 - d_1) there.
  Decision look_at_collinear(Piece& piece) {
    std::optional<Ends> first;
    for (std::size_t axis = 0; axis < 3 && !first; ++axis) {
      bool vanish = true;
      for_each_difference(axis, [&](const Ends& d) {
        vanish &= d[0].is_zero() && d[1].is_zero();
        if (d[0].sign() * d[1].sign() >= 0) return;
        if (first && sign_at_zero_of(d, *first) != (*first)[0].sign()) return;
        if (meet_on_line([&](const Ends& e) { return sign_at_zero_of(d, e); })) first = d;
      });
      if (!vanish) break;
    }
    if (!first) return Decision::no;
    if (want_ == Want::yes_no) return Decision::yes;
    const Triple d0((*first)[0]), d1((*first)[1]);
    const FixedCubic<Triple> whole = {d0, d0 + d0 + d1, d0 + d1 + d1, d1};
    time_ = bracket(piece, whole, {d0 + d0 + d0, whole[1], whole[2], d1 + d1 + d1}, d0.sign());
    return Decision::yes;
  }

  using Ends = std::array<typename FixedProducts<W>::Coordinate, 2>;

  static int sign_at_zero_of(const Ends& d, const Ends& e) {
    return (d[0] * e[1] - d[1] * e[0]).sign() * d[0].sign();
  }

  // Returns a difference at an end of a piece, up to a positive factor.
  static auto value_at(double time, const Ends& d) {
    constexpr std::uint64_t parts = std::uint64_t{1} << max_fixed_depth;
    const auto behind = static_cast<std::uint64_t>(time * parts);
    return d[0].times(parts - behind) + d[1].times(behind);
  }

  // Visits the differences of points of the two groups along this axis, at t=0 and at t=1.
  template <class Visit>
  void for_each_difference(std::size_t axis, Visit visit) const {
    for (std::size_t i = 0; i < first_group_; ++i) {
      for (std::size_t j = first_group_; j < 4; ++j) {
        visit(Ends{products_.difference(i, j, 0, axis), products_.difference(i, j, 1, axis)});
      }
    }
  }

  // Looks at the roots of the dependencies of this axis. REQUIRES that not all of them vanish.
  Decision look_at_changes(Piece& piece, std::size_t axis) {
    const auto& dependency = piece.dependency(axis, products_);
    std::array<PieceSigns, 4> signs;
    for (std::size_t i = 0; i < 4; ++i) {
      signs[i] = piece_signs(dependency[i]);
      if (signs[i].changes > 1) return Decision::open;
    }
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < 4; ++i) {
      if (signs[i].is_known() || (first && !is_before(dependency[i], signs[i].first,
                                                      dependency[*first], signs[*first].first))) {
        continue;
      }
      const Decision found = look_at_root(piece, dependency[i], signs[i].first);
      if (found == Decision::open) return Decision::open;
      if (found == Decision::no) continue;
      if (want_ == Want::yes_no) return Decision::yes;
      first = i;
    }
    if (!first) return Decision::no;
    const auto over_step = products_.dependency(axis)[*first];
    auto whole = raised<W>(over_step);
    whole[0] = Triple(over_step[0]);
    whole[3] = Triple(over_step[2]);
    time_ = bracket(piece, whole, raised<W>(dependency[*first]), signs[*first].first);
    return Decision::yes;
  }

  using Quadratic = FixedQuadratic<typename Piece::Minor>;

  // Returns whether the root of a comes before that of b. REQUIRES that each has one root in the
  // open piece and that sign before it.
  static bool is_before(const Quadratic& a, int before_a, const Quadratic& b, int before_b) {
    return sign_at_root<W>(b, a, before_a) == before_b;
  }

  // Decides whether there is a contact at the root of `quadratic` in the open piece. REQUIRES that
  // it has one root there and the sign `before` before it, and that the points are coplanar.
  Decision look_at_root(Piece& piece, const Quadratic& quadratic, int before) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      SignSet there;
      for (const auto& l : piece.dependency(axis, products_)) {
        const PieceSigns signs = piece_signs(l);
        there.add(signs.is_known() ? signs.first : sign_at_root<W>(l, quadratic, before));
      }
      if (there.both()) return Decision::no;
      if (there.any()) return Decision::yes;
    }
    const bool meet = meet_on_line([&](const Ends& d) {
      using Minor = typename Piece::Minor;
      const Minor lo(value_at(piece.lo, d)), hi(value_at(piece.hi, d));
      if (lo.sign() * hi.sign() > 0) return lo.sign();
      return sign_at_root<W>({lo + lo, lo + hi, hi + hi}, quadratic, before);
    });
    return meet ? Decision::yes : Decision::no;
  }

  // Decides by the signs that are known throughout the open piece. If both strict signs occur
  // along some axis there is no contact. If all signs along some axis are known and not all zero,
  // and the cubic has a root inside (`has_root`), there is one.
  Decision look_at_signs(Piece& piece, bool has_root) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      SignSet inside;
      bool are_known = true;
      for (const auto& l : piece.dependency(axis, products_)) {
        const PieceSigns signs = piece_signs(l);
        if (signs.is_known()) {
          inside.add(signs.first);
        } else {
          are_known = false;
        }
      }
      if (inside.both()) return Decision::no;
      if (has_root && are_known && inside.any()) return Decision::yes;
    }
    return Decision::open;
  }

  // Decides whether there is a contact at the root of `cubic` in the open piece. REQUIRES that the
  // cubic has one root there and the sign `before` before it.
  Decision look_at_root(Piece& piece, const FixedCubic<Triple>& cubic, int before) {
    std::optional<SignAtRoot<W>> sign_at_root;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      SignSet there;
      bool are_known = true;
      const auto& dependency = piece.dependency(axis, products_);
      for (const auto& l : dependency) {
        const PieceSigns signs = piece_signs(l);
        if (signs.is_known()) {
          there.add(signs.first);
        } else if (signs.changes == 1) {
          if (!sign_at_root) sign_at_root.emplace(cubic, before, bits_);
          there.add(sign_at_root->of(l, signs.first));
        } else {
          are_known = false;
        }
      }
      if (there.both()) return Decision::no;
      if (are_known && there.any()) return Decision::yes;
    }
    return Decision::open;
  }

  // Returns the enclosure of the one root of a cubic in the open piece. `whole` holds the cubic
  // over the step, in the form of coplanarity(); `cubic` holds it over the piece.
  TimeEnclosure bracket(const Piece& piece, const FixedCubic<Triple>& whole,
                        const FixedCubic<Triple>& cubic, int before) const {
    Cubic f;
    for (std::size_t i = 0; i < 4; ++i) f[i] = cubic[i].approximate(3 * bits_);
    const double guess = piece.lo + guess_root(f) * (piece.hi - piece.lo);
    return FixedRoot<W>(whole, bits_).bracket(before, piece.lo, piece.hi, guess);
  }

  int bits_;
  std::size_t first_group_;
  Want want_;
  FixedProducts<W> products_;
  FixedCubic<Triple> b_;
  bool coplanar_ = false;
  TimeEnclosure time_;
};

// Calls call(width) with the least of a few widths that holds the coordinates. Returns `otherwise`
// if none does.
template <class Result, class Call>
Result with_width(int bits, const Result& otherwise, Call call) {
  if (bits <= most_bits<1>) return call(std::integral_constant<std::size_t, 1>());
  if (bits <= most_bits<2>) return call(std::integral_constant<std::size_t, 2>());
  if (bits <= most_bits<3>) return call(std::integral_constant<std::size_t, 3>());
  if (bits <= most_bits<5>) return call(std::integral_constant<std::size_t, 5>());
  return otherwise;
}

}  // namespace

FixedResult fixed_contact(const FourPoints& query, Want want) {
  const QueryIntegers integers(query);
  return with_width(integers.bits(), FixedResult{}, [&](auto width) -> FixedResult {
    using Search = FixedSearch<decltype(width)::value>;
    Search search(integers, query.first_group, want);
    switch (search.run()) {
      case Decision::no:
        return {Decision::no, {}};
      case Decision::yes:
        return {Decision::yes, search.time()};
      case Decision::open:
        break;
    }
    return {};
  });
}

std::optional<TimeEnclosure> fixed_bracketed_time(const FourPoints& query, double lo, double hi,
                                                  double guess) {
  const QueryIntegers integers(query);
  using Time = std::optional<TimeEnclosure>;
  return with_width(integers.bits(), Time(), [&](auto width) -> Time {
    constexpr std::size_t W = decltype(width)::value;
    const FixedProducts<W> products(integers, query.first_group);
    const FixedRoot<W> root(products.coplanarity(), integers.bits());
    const int sign_lo = root.sign_at(lo);
    assert(sign_lo != 0);
    const TimeEnclosure time = root.bracket(sign_lo, lo, hi, guess);
    // An end moves only to a time at which the sign was seen.
    assert(time.hi != hi || root.sign_at(hi) == -sign_lo);
    return time;
  });
}

}  // namespace assay::detector
