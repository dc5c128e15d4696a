#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

#include "oracle/distance/feature_distance.h"
#include "oracle/query/integer_polynomial.h"
#include "oracle/query/times/times.h"

namespace assay::oracle {

namespace {

IntegerPolynomial square(const PolynomialVector& v) { return dot(v, v); }

}  // namespace

Regions::Regions(const detector::FourPoints& q, const Separation& d) : first_group_(q.first_group) {
  assert(d.first >= 0 && d.second >= -d.first);
  const detector::Point distances = {d.first, d.second, 0};
  const auto& p = q.points;
  const std::array with_distances = {p[0], p[1], p[2], p[3],
                                     detector::MovingPoint{distances, distances}};
  const IntegerScale scale(with_distances);
  for (int j = 1; j < 4; ++j) x_[j] = moving_difference(scale, p[0], p[j]);
  const Integer sum = scale(d.first) + scale(d.second);
  if (sum != 0) squared_.c = {sum * sum};
}

Region Regions::points(int p, int a) const { return {square(x_[p] - x_[a]) - squared_, {}}; }

Region Regions::point_edge(int p, int a, int b) const {
  const PolynomialVector e = x_[b] - x_[a], w = x_[p] - x_[a];
  const IntegerPolynomial length = square(e), foot = dot(w, e);
  return {square(cross(w, e)) - squared_ * length, {foot, length - foot}, length};
}

Region Regions::point_face() const {
  const PolynomialVector ab = x_[2] - x_[1], ac = x_[3] - x_[1], ap = x_[0] - x_[1];
  const PolynomialVector normal = cross(ab, ac);
  const IntegerPolynomial area = square(normal), height = dot(ap, normal);
  // The sides of ab and ca on which the foot lies; all three values add up to the area.
  const IntegerPolynomial at_ab = dot(normal, cross(ab, ap)), at_ca = dot(normal, cross(ap, ac));
  return {height * height - squared_ * area, {at_ab, at_ca, area - at_ab - at_ca}, area};
}

Region Regions::edges() const {
  const PolynomialVector u = x_[1] - x_[0], v = x_[3] - x_[2], w = x_[2] - x_[0];
  const PolynomialVector normal = cross(u, v);
  const IntegerPolynomial area = square(normal), height = dot(w, normal);
  // With |N|^2 = area, the feet are x_0 + s/area u and x_2 + t/area v.
  const IntegerPolynomial s = dot(cross(w, v), normal), t = dot(cross(w, u), normal);
  return {height * height - squared_ * area, {s, area - s, t, area - t}, area};
}

Region Regions::operator[](int i) const {
  assert(i >= 0 && i < size());
  if (first_group_ == 1) {
    constexpr int face = 6;
    if (i == face) return point_face();
    return i < 3 ? points(0, 1 + i) : point_edge(0, 1 + i % 3, 1 + (i + 1) % 3);
  }
  constexpr int both = 8;
  if (i == both) return edges();
  if (i < 4) return points(i / 2, 2 + i % 2);
  return i < 6 ? point_edge(i - 4, 2, 3) : point_edge(i - 4, 0, 1);
}

// Zeros are isolated by Descartes' rule on pieces of the step whose ends are doubles. A piece is
// halved by the number of doubles in it: so 62 halvings lead to any enclosure, whatever the
// exponents. At an isolated zero the signs of other polynomials can be found. Several zeros between
// adjacent doubles are a cluster: there time is scaled so that the two doubles become 0 and 1.
namespace {

using detector::TimeEnclosure;

// Returns the sign of p between s and e by Descartes' rule; 0 if it is not certain, or if p is
// zero.
int sign_between(const IntegerPolynomial& p, double s, double e) {
  bool positive = false, negative = false;
  for (const Integer& x : bernstein_over_unit(on_piece(p, s, e))) {
    positive = positive || sgn(x) > 0;
    negative = negative || sgn(x) < 0;
  }
  return static_cast<int>(positive && !negative) - static_cast<int>(negative && !positive);
}

// Returns 1 if the conditions hold at all times between s and e, -1 if some condition fails at all
// of them, 0 if neither is certain.
int conditions_between(const Region& region, double s, double e) {
  bool hold = true;
  for (const IntegerPolynomial& g : region.not_negative) {
    const int sign = sign_between(g, s, e);
    if (sign < 0) return -1;
    hold = hold && (sign > 0 || g.is_zero());
  }
  return static_cast<int>(hold && sign_between(region.positive, s, e) > 0);
}

bool conditions_hold_at(const Region& region, double t) {
  return sign_at(region.positive, t) > 0 &&
         std::all_of(region.not_negative.begin(), region.not_negative.end(),
                     [&](const IntegerPolynomial& g) { return sign_at(g, t) >= 0; });
}

// Returns the sign of g at the only zero of f between lo and hi, which is simple and is no zero of
// g. It shrinks the piece until g has one sign on it.
int sign_at_zero_of_other(IntegerPolynomial f, IntegerPolynomial g, double lo, double hi) {
  for (;;) {
    // x = 0 is the end nearer to the zero, because doubles are densest at 0.
    const IntegerPolynomial piece = on_piece(f, lo, hi);
    const int at_lo = sign_at(piece, 0), at_middle = sign_at(piece, 0.5);
    if (at_lo * at_middle > 0) std::swap(lo, hi);
    f = on_piece(f, lo, hi);
    g = on_piece(g, lo, hi);
    if (at_middle == 0) return sign_at(g, 0.5);
    const TimeEnclosure zero = simple_zero_time(f, 0, 0.5);
    if (zero.lo == zero.hi) return sign_at(g, zero.lo);
    if (const int sign = sign_between(g, zero.lo, zero.hi)) return sign;
    lo = zero.lo;
    hi = zero.hi;
  }
}

// Returns the sign of g at the only zero of f between lo and hi. REQUIRES that it is simple, and f
// not zero at lo and hi.
int sign_at_zero(const IntegerPolynomial& f, const IntegerPolynomial& g, double lo, double hi) {
  if (g.is_zero()) return 0;
  if (const int sign = sign_between(g, lo, hi)) return sign;
  const IntegerPolynomial common = common_divisor(f, g);
  if (sign_at(common, lo) * sign_at(common, hi) < 0) return 0;  // g has that zero, too
  return sign_at_zero_of_other(f, g, lo, hi);
}

bool conditions_hold_at_zero(const Region& region, const IntegerPolynomial& f, double lo,
                             double hi) {
  return sign_at_zero(f, region.positive, lo, hi) > 0 &&
         std::all_of(region.not_negative.begin(), region.not_negative.end(),
                     [&](const IntegerPolynomial& g) { return sign_at_zero(f, g, lo, hi) >= 0; });
}

std::uint64_t bits(double t) { return std::bit_cast<std::uint64_t>(t + 0.0); }
bool adjacent(double lo, double hi) { return bits(hi) - bits(lo) <= 1; }
double of_bits(std::uint64_t b) { return std::bit_cast<double>(b); }

// Returns where to divide a piece. In a piece from 0 on, the exponent is multiplied by 8, because
// few zeros are tiny.
double middle(double lo, double hi) {
  const int exponent = std::ilogb(hi);
  constexpr int longest = 8, least = -1000;
  if (lo == 0 && (exponent - 1) * longest > least) return std::ldexp(1, (exponent - 1) * longest);
  return of_bits(bits(lo) + (bits(hi) - bits(lo)) / 2);
}

struct Piece {
  double lo, hi;       // the piece is (lo, hi]
  bool hold = false;   // the conditions are known to hold on it
  bool aimed = false;  // made by aim()
};

// Appends the piece in parts, later ones first: a tiny part about a zero of the derivative, and the
// parts before and after it. Returns whether it did. Two neighbouring zeros (or near zeros) lie
// about such a zero, and only pieces as small as their gap separate them.
bool aim(const IntegerPolynomial& f, const Piece& piece, std::vector<Piece>& left) {
  const IntegerPolynomial slope = derivative(f);
  const int at_lo = sign_at(slope, piece.lo);
  if (at_lo * sign_at(slope, piece.hi) >= 0) return false;
  constexpr std::uint64_t near = 16;
  const std::uint64_t first = bits(piece.lo), last = bits(piece.hi);
  const std::uint64_t at = bits(guess_zero(slope, piece.lo, piece.hi, at_lo));
  if (at < first + 2 * near || at + 2 * near > last) return false;
  const double before = of_bits(at - near), after = of_bits(at + near);
  left.push_back({after, piece.hi, piece.hold, true});
  left.push_back({before, after, piece.hold, true});
  left.push_back({piece.lo, before, piece.hold, true});
  return true;
}

// Does first_zero. `in_cluster(f, lo, hi)` says whether the conditions hold at a zero of f between
// two adjacent doubles, where f has several zeros, all simple.
template <class InCluster>
std::optional<TimeEnclosure> scan(const Region& region, double s, double e,
                                  const InCluster& in_cluster) {
  IntegerPolynomial f = region.f;
  bool simple = false;                 // all zeros of f are simple
  std::vector<Piece> left = {{s, e}};  // later pieces below earlier ones
  while (!left.empty()) {
    Piece piece = left.back();
    const auto [lo, hi] = std::pair(piece.lo, piece.hi);
    left.pop_back();
    std::vector<Integer> b = bernstein_over_unit(on_piece(f, lo, hi));
    if (!simple && sign_changes(b) > 1) {
      const IntegerPolynomial multiple = common_divisor(f, derivative(f));
      if (multiple.degree() > 0) f = quotient(f, multiple);
      simple = true;
      b = bernstein_over_unit(on_piece(f, lo, hi));
    }
    const int changes = sign_changes(b);
    const int conditions =
        changes == 0 ? -1 : (piece.hold ? 1 : conditions_between(region, lo, hi));
    if (conditions >= 0) {
      if (changes == 1 && sgn(b.front()) != 0 && sgn(b.back()) != 0) {
        const TimeEnclosure time = simple_zero_time(f, lo, hi);
        if (conditions > 0) return time;
        if (time.lo == time.hi ? conditions_hold_at(region, time.lo)
                               : conditions_hold_at_zero(region, f, time.lo, time.hi)) {
          return time;
        }
        continue;
      }
      if (!adjacent(lo, hi)) {
        piece.hold = conditions > 0;
        if (changes == 2 && !piece.aimed && aim(f, piece, left)) continue;
        const double mid = middle(lo, hi);
        left.push_back({mid, hi, piece.hold, piece.aimed});
        left.push_back({lo, mid, piece.hold, piece.aimed});
        continue;
      }
      if (in_cluster(f, lo, hi)) return TimeEnclosure{lo, hi};
    }
    if (sgn(b.back()) == 0 && conditions_hold_at(region, hi)) return TimeEnclosure{hi, hi};
  }
  return {};
}

// Returns p(x / 2), up to a positive factor.
IntegerPolynomial halved(IntegerPolynomial p) {
  const int n = p.degree();
  for (int i = 0; i < n; ++i) p.c[i] <<= static_cast<mp_bitcnt_t>(n - i);
  return p;
}

// Returns the half of the piece from one adjacent double towards the other, as a step of its own.
Region half_seen_from(const IntegerPolynomial& f, const Region& region, double from, double to) {
  const auto half_of = [&](const IntegerPolynomial& p) { return halved(on_piece(p, from, to)); };
  Region half{half_of(f), {}, half_of(region.positive)};
  for (const IntegerPolynomial& g : region.not_negative) half.not_negative.push_back(half_of(g));
  return half;
}

bool some_zero_in_cluster(const Region& region, const IntegerPolynomial& f, double lo, double hi) {
  std::vector<Region> left;
  const auto put_both_halves = [&left](const Region& whole, const IntegerPolynomial& of,
                                       double from, double to) {
    // Each end becomes 0 once, because doubles are densest at 0 and separate the zeros next to it.
    left.push_back(half_seen_from(of, whole, from, to));
    left.push_back(half_seen_from(of, whole, to, from));
  };
  put_both_halves(region, f, lo, hi);
  while (!left.empty()) {
    const Region half = std::move(left.back());
    left.pop_back();
    const auto later = [&](const IntegerPolynomial& of, double from, double to) {
      put_both_halves(half, of, from, to);
      return false;
    };
    if (scan(half, 0, 1, later)) return true;
  }
  return false;
}

}  // namespace

bool near_at_start(const Region& region) {
  return sign_at(region.f, 0) <= 0 && conditions_hold_at(region, 0);
}

std::optional<TimeEnclosure> first_zero(const Region& region, double s, double e) {
  if (region.f.is_zero() || region.positive.is_zero()) return {};
  return scan(region, s, e, [&](const IntegerPolynomial& f, double lo, double hi) {
    return some_zero_in_cluster(region, f, lo, hi);
  });
}

}  // namespace assay::oracle
