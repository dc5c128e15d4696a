#include "detector/contact/contact_plain.h"

#include "detector/contact/contact_pieces.h"

namespace assay::detector {
namespace {

constexpr int max_plain_depth = 4;

template <class Number, std::size_t n>
Number value_at(std::array<Number, n> b, Number s) {
  for (std::size_t level = n - 1; level > 0; --level) {
    for (std::size_t i = 0; i < level; ++i) b[i] += s * (b[i + 1] - b[i]);
  }
  return b[0];
}

template <class Number>
struct PlainSearch {
  using Piece = ContactPiece<Number>;

  bool may_halve(int depth) const { return depth < max_plain_depth; }

  // Takes the place of integers: it takes the signs at a root as computed. It does not see a root
  // at which F does not change its sign. If the points are coplanar throughout the piece, it looks
  // at the piece's two ends only.
  bool open(const Piece& piece) {
    const Number first = piece.f.front(), last = piece.f.back();
    if (first == 0 && touches(piece, 0)) return true;
    if (first * last < 0 && touches(piece, guess_root(piece.f))) return true;
    return last == 0 && touches(piece, 1);
  }

  void contact(const Piece& piece, Number, int) {
    report(piece, want == Want::first_time ? guess_root(piece.f) : 0);
  }

  bool touches(const Piece& piece, Number s) {
    for (const auto& axis : piece.dependencies) {
      bool positive = false, negative = false;
      for (const auto& l : axis) {
        const Number value = value_at(l, s);
        positive |= value > 0;
        negative |= value < 0;
      }
      if (positive && negative) return false;
      if (!positive && !negative) continue;
      report(piece, s);
      return true;
    }
    if (!overlap(piece.lo + s * (piece.hi - piece.lo))) return false;
    report(piece, s);
    return true;
  }

  // For points on one line: whether the two groups overlap along every axis.
  bool overlap(Number time) const {
    for (std::size_t k = 0; k < 3; ++k) {
      bool before = true, behind = true;
      for (int i = 0; i < query.first_group; ++i) {
        for (int j = query.first_group; j < 4; ++j) {
          const Number a = place(i, k, time), b = place(j, k, time);
          before &= a < b;
          behind &= a > b;
        }
      }
      if (before || behind) return false;
    }
    return true;
  }

  Number place(int i, std::size_t k, Number time) const {
    const MovingPoint& p = query.points[static_cast<std::size_t>(i)];
    const auto x_t0 = static_cast<Number>(p.t0[k]), x_t1 = static_cast<Number>(p.t1[k]);
    return x_t0 + time * (x_t1 - x_t0);
  }

  void report(const Piece& piece, Number s) {
    const double time = piece.lo + s * (piece.hi - piece.lo);
    result = {true, {time, time}, ContactRung::filter};
  }

  const FourPoints& query;
  Want want;
  ContactResult result{false, {}, ContactRung::filter};
};

}  // namespace

template <class Number>
ContactResult plain_contact(const FourPoints& query, Want want) {
  PlainSearch<Number> search{query, want};
  ContactPieces<NoBounds<Number>, PlainSearch<Number>>(query, search).run();
  return search.result;
}

template ContactResult plain_contact<double>(const FourPoints&, Want);
template ContactResult plain_contact<float>(const FourPoints&, Want);

}  // namespace assay::detector
