#include <algorithm>
#include <cmath>
#include <optional>

#include "detector/contact/rungs.h"

namespace assay::detector {
namespace {

struct FilterSearch {
  using Piece = ContactPiece<double>;

  bool may_halve(int depth, bool ends_are_sure) {
    const bool may_end_sure = all_free && ends_are_sure;
    return depth < (may_end_sure ? max_filter_depth : max_unsure_depth) &&
           halvings++ < max_filter_halvings;
  }

  bool open(const Piece&) {
    all_free = false;
    return false;
  }

  void contact(const Piece& piece, double f_bound, int f_lo) {
    result.decision = Decision::yes;
    if (want == Want::yes_no) return;
    result.lo = piece.lo;
    result.hi = piece.hi;
    // Then F has exactly one root: its coefficients change sign once, whatever the uncertain signs
    // are.
    const bool single =
        sign_beyond(piece.f[1], f_bound) == f_lo || sign_beyond(piece.f[2], f_bound) == -f_lo;
    result.time_bracketed = all_free && single;
    result.time_guess = piece.lo + guess_root(piece.f) * (piece.hi - piece.lo);
  }

  Want want;
  bool all_free = true;  // of the pieces seen so far
  int halvings = 0;
  FilterResult result{Decision::no};
};

// is_below(a, b) says whether a is below b, by more than the gap that is asked for.
template <class IsBelow>
bool are_separated(const FourPoints& query, const IsBelow& is_below) {
  const int split = query.first_group;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto sense_at = [&](const Point MovingPoint::*end) {
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
      return is_below(hi[0], lo[1]) ? -1 : is_below(hi[1], lo[0]) ? 1 : 0;
    };
    const int sense = sense_at(&MovingPoint::t0);
    if (sense != 0 && sense_at(&MovingPoint::t1) == sense) return true;
  }
  return false;
}

// How far pieces are halved, and how many halvings a query may take. Up to the first piece that
// stays open the limit is max_depth, because that piece decides the answer. After it the limit is
// max_depth_after_open: pieces then only serve to find a time at which a contact is certain.
constexpr int max_depth = 20, max_depth_after_open = 6, max_halvings = 64;

struct BoundedSearch {
  using Piece = ContactPiece<double>;

  bool may_halve(int depth, bool) {
    return depth < (result.contact ? max_depth_after_open : max_depth) && halvings++ < max_halvings;
  }

  bool open(const Piece& piece) {
    if (!result.contact) result = {true, {piece.lo, 1}, ContactRung::open};
    return want == Want::yes_no;
  }

  void contact(const Piece& piece, double f_bound, int) {
    if (want == Want::first_time) {
      const TimeEnclosure root = enclose_first_root(piece.f, f_bound, piece.lo, piece.hi);
      if (!result.contact) result.time.lo = root.lo;
      result.time.hi = root.hi;
    }
    result.contact = true;
    result.rung = ContactRung::filter;
  }

  Want want;
  int halvings = 0;
  ContactResult result{false, {}, ContactRung::filter};
};

}  // namespace

bool separated_along_an_axis(const FourPoints& query, double by) {
  // A plain comparison is faster than a difference, and most queries ask for contact.
  if (by == 0) return are_separated(query, [](double a, double b) { return a < b; });
  return are_separated(query, [by](double a, double b) { return b - a > by; });
}

FilterResult filter_contact(const FourPoints& query, Want want) {
  FilterSearch search{want};
  ContactPieces<ProvedBounds, FilterSearch>(query, search).run();
  if (search.result.decision == Decision::no && !search.all_free) {
    search.result.decision = Decision::open;
  }
  return search.result;
}

ContactResult bounded_contact(const FourPoints& query, Want want) {
  BoundedSearch search{want};
  ContactPieces<ProvedBounds, BoundedSearch>(query, search).run();
  return search.result;
}

// A root is guessed, and two places are tried, one a little before the guess and one a little
// after it. If the coefficients up to the first place have one sign, the cubic surely has no root
// up to there. If the value at the second place has the other sign, the cubic has surely changed
// its sign by then. If several roots or a double root are near, this may fail; then halvings find
// the two places.
//
// Error bounds, in the notation of bernstein.h; B is the largest |coefficient| that is split.
//
//   quantity         | operations                             | error in u                | size
//   a level at s     | (1 - s) x + s y, s in [0,1]            | as before + at most 2.5 B | B
//   split at s       | three such levels                      | as before + 7.5 B         | B
//   halved           | (x + y) / 2 at three levels            | as before + 3 B           | B
//
// In the 2.5 B of a level, 1 - s costs B / 2, because it is at most 1; its product with x costs
// (1 - s) B, the product of s and y costs s B, and the sum costs B. The bound so far is at most B
// (else no sign is sure), so adding to it costs B more. The code adds 9 B for a split and 5 B for a
// halving; the rest is slack. s itself is exact: a time t in [lo,hi] and lo are multiples of the
// last place of t, so t - lo is a double, and hi - lo is a power of two.

namespace {

double greatest(const Cubic& f) {
  return std::max({std::abs(f[0]), std::abs(f[1]), std::abs(f[2]), std::abs(f[3])});
}

// Returns the coefficients over [0,s].
Cubic left_of(Cubic f, double s) {
  Cubic left;
  for (std::size_t level = 0; level < 4; ++level) {
    left[level] = f[0];
    for (std::size_t i = 0; i + 1 + level < 4; ++i) f[i] = (1 - s) * f[i] + s * f[i + 1];
  }
  return left;
}

struct RootPiece {
  Cubic f;
  double bound, lo, hi;

  // Returns whether the piece may be halved. If so, its middle is a multiple of 2^-53, and exact.
  bool may_halve() const { return hi - lo > 0x1p-52; }
};

std::array<RootPiece, 2> halves(const RootPiece& piece) {
  const double middle = (piece.lo + piece.hi) / 2;
  const double bound = piece.bound + 5 * unit_roundoff * greatest(piece.f);
  std::array<RootPiece, 2> out{RootPiece{{}, bound, piece.lo, middle},
                               RootPiece{{}, bound, middle, piece.hi}};
  halve(piece.f, out[0].f, out[1].f);
  return out;
}

// Returns a time up to which the piece is surely free of roots, as late as it is found.
double free_until(RootPiece piece, int sign) {
  while (piece.may_halve() && sign_beyond(piece.f[0], piece.bound) == sign) {
    const auto [left, right] = halves(piece);
    piece = sure_sign(left.f, left.bound) == sign ? right : left;
  }
  return piece.lo;
}

// Returns a time at which the cubic surely has the sign that it has at the piece's end, as early as
// it is found.
double changed_at(RootPiece piece, int sign) {
  while (piece.may_halve()) {
    const auto [left, right] = halves(piece);
    piece = sign_beyond(left.f[3], left.bound) == -sign ? left : right;
  }
  return piece.hi;
}

std::optional<TimeEnclosure> around_guess(const RootPiece& piece, int sign) {
  const Cubic& f = piece.f;
  const double bound = piece.bound + 9 * unit_roundoff * greatest(f);
  const double width = piece.hi - piece.lo, s = guess_root(f);
  const double slope = 3 * std::abs((1 - s) * (1 - s) * (f[1] - f[0]) +
                                    2 * s * (1 - s) * (f[2] - f[1]) + s * s * (f[3] - f[2]));
  double reach = 2 * bound / slope + 0x1p-52;
  constexpr int attempts = 3;
  for (int i = 0; i < attempts && reach < 1; ++i, reach *= 8) {
    const double lo = std::max(piece.lo, piece.lo + (s - reach) * width);
    const double hi = std::min(piece.hi, piece.lo + (s + reach) * width);
    const bool free_before =
        lo == piece.lo || sure_sign(left_of(f, (lo - piece.lo) / width), bound) == sign;
    const bool changed =
        hi == piece.hi || sign_beyond(left_of(f, (hi - piece.lo) / width)[3], bound) == -sign;
    if (free_before && changed) return TimeEnclosure{lo, hi};
  }
  return std::nullopt;
}

}  // namespace

TimeEnclosure enclose_first_root(const Cubic& f, double bound, double lo, double hi) {
  const RootPiece piece{f, bound, lo, hi};
  const int sign = sign_beyond(f[0], bound);
  if (const auto found = around_guess(piece, sign)) return *found;
  return {free_until(piece, sign), changed_at(piece, sign)};
}

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

  bool may_halve(int depth, bool) const { return depth < max_plain_depth; }

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
      for (std::size_t i = 0; i < 4; ++i) {
        const Number value = value_at(QuadraticOf<Number>{axis[0][i], axis[1][i], axis[2][i]}, s);
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

  // Returns, for points on one line, whether the two groups overlap along every axis.
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
