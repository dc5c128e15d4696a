// A root is guessed, and two places are tried, one a little before the guess and one a little
// after it. If the coefficients up to the first place have one sign, the cubic surely has no root
// up to there. If the value at the second place has the other sign, the cubic has surely changed
// its sign by then. If several roots or a double root are near, this may fail; then halvings find
// the two places.
//
// Error bounds, in the notation of bernstein.h; B is the largest |coefficient| that is split.
//
//   quantity         | operations                             | error in u                | size
//   a level at s     | (1 - s) x + s y, s in [0,1]            | as before + at most 3 B   | B
//   split at s       | three such levels                      | as before + 9 B           | B
//   halved           | (x + y) / 2 at three levels            | as before + 3 B           | B
//
// Of the 3 B of a level, 1 - s costs (1 - s) B, its product with x as much, the product of s and y
// costs s B, and the sum costs B. The code adds 10 B for a split and 4 B for a halving: 1 B is
// slack. s itself is exact: a time t in [lo,hi] and lo are multiples of the last place of t, so
// t - lo is a double, and hi - lo is a power of two.
#include "detector/contact/first_root.h"

#include <cmath>
#include <optional>

#include "detector/contact/contact_pieces.h"

namespace assay::detector {
namespace {

double greatest(const Cubic& f) {
  return std::max({std::abs(f[0]), std::abs(f[1]), std::abs(f[2]), std::abs(f[3])});
}

// The coefficients over [0,s].
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

  // While this holds every middle is a multiple of 2^-53, and so it is exact.
  bool may_halve() const { return hi - lo > 0x1p-52; }
};

std::array<RootPiece, 2> halves(const RootPiece& piece) {
  const double middle = (piece.lo + piece.hi) / 2;
  const double bound = piece.bound + 4 * unit_roundoff * greatest(piece.f);
  std::array<RootPiece, 2> out{RootPiece{{}, bound, piece.lo, middle},
                               RootPiece{{}, bound, middle, piece.hi}};
  halve(piece.f, out[0].f, out[1].f);
  return out;
}

// A time up to which the piece is surely free of roots, as late as it is found.
double free_until(RootPiece piece, int sign) {
  while (piece.may_halve() && sign_beyond(piece.f[0], piece.bound) == sign) {
    const auto [left, right] = halves(piece);
    piece = sure_sign(left.f, left.bound) == sign ? right : left;
  }
  return piece.lo;
}

// A time at which the cubic surely has the sign that it has at the piece's end, as early as it is
// found.
double changed_at(RootPiece piece, int sign) {
  while (piece.may_halve()) {
    const auto [left, right] = halves(piece);
    piece = sign_beyond(left.f[3], left.bound) == -sign ? left : right;
  }
  return piece.hi;
}

std::optional<TimeEnclosure> around_guess(const RootPiece& piece, int sign) {
  const Cubic& f = piece.f;
  const double bound = piece.bound + 10 * unit_roundoff * greatest(f);
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

}  // namespace assay::detector
