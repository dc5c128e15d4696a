#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "oracle/referee/distance_referee.h"

namespace assay::oracle {

// Returns the hull with bounds of d. Each scaled term of d is wrong by at most 2^-1075, from
// underflow, and their sum has one rounding. So the neighbour of the sum is beyond the exact sum,
// apart from that underflow.
DoubleReach double_reach(const detector::FourPoints& query, const detector::Separation& d) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), underflow = 0x1p-1070;
  DoubleReach reach{double_hull(query)};
  const int exponent = reach.hull.exponent;
  const double sum = std::ldexp(d.first, -exponent) + std::ldexp(d.second, -exponent);
  if (std::isnan(sum)) reach.hull.usable = false;  // infinities of both signs
  reach.least = std::max(0.0, std::nextafter(sum, -infinity) - underflow);
  reach.most = std::nextafter(sum, infinity) + underflow;
  return reach;
}
IntegerReach integer_reach(const detector::FourPoints& query, const detector::Separation& d) {
  IntegerReach reach{integer_hull(query), 0};
  mpq_class scaled = mpq_class(d.first) + mpq_class(d.second);
  const int unit = reach.hull.unit;
  if (unit >= 0) scaled >>= static_cast<mp_bitcnt_t>(unit);
  if (unit < 0) scaled <<= static_cast<mp_bitcnt_t>(-unit);
  // d may need a finer unit than the coordinates do.
  reach.d = scaled.get_num();
  for (Hull<mpz_class>* hull : {&reach.hull.t0, &reach.hull.t1}) {
    for (auto& corner : hull->corner) corner = times(corner, scaled.get_den());
  }
  return reach;
}
namespace {

// Returns v with length 1: places on one line of sight from the origin have the same result. Zero
// stays zero.
Vector<double> unit_vector(Vector<double> v) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  if (!(largest > 0)) return {};
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (double& x : v) x = std::ldexp(x, -exponent);
  return times(v, 1 / std::sqrt(inner(v, v)));
}

// Judges a pair of directions in double.
//
// Bound, u = 2^-53. The products n_s.c(s) and n_e.c(e), and the middle sum of two products, are
// wrong by at most 7.1 u S, S = sum over k of (|n_s[k]| + |n_e[k]|) size[k], and S itself is
// computed with less than 8 roundings (existence.cpp, at `judge`); 8 u S is enough, and the spare
// 0.9 u S covers underflow, because the directions are unit vectors and so S > 2^-901. A length |n|
// as computed is wrong by 2.6 u: three squares, two sums of positive numbers and a root. The
// product with d, the sum of two of these and the sum with the bound add 4 u, so a length that is
// taken 16 u longer makes the comparison sure.
SeparationProof judged(const DoubleReach& reach, const Hull<double>& at_s, const Hull<double>& at_e,
                       const Vector<double>& n_s, const Vector<double>& n_e) {
  constexpr double u = 0x1p-53;
  constexpr double doubt = 64;  // a direction may be wrong by some units in the last place too
  double scale_sum = 0;
  for (int k = 0; k < 3; ++k) {
    scale_sum += (std::fabs(n_s[k]) + std::fabs(n_e[k])) * reach.hull.size[k];
  }
  if (!(scale_sum > 0)) return SeparationProof::not_found;
  const double bound = 8 * u * scale_sum;
  const double first = reach.most * (std::sqrt(inner(n_s, n_s)) * (1 + 16 * u));
  const double last = reach.most * (std::sqrt(inner(n_e, n_e)) * (1 + 16 * u));
  auto result = SeparationProof::separated;
  for (int i = 0; i < at_s.corners; ++i) {
    const std::array products = {
        inner(n_s, at_s.corner[i]),
        inner(n_s, at_e.corner[i]) + inner(n_e, at_s.corner[i]),
        inner(n_e, at_e.corner[i]),
    };
    const std::array needed = {first, first + last, last};
    for (std::size_t j = 0; j < products.size(); ++j) {
      if (products[j] > needed[j] + bound) continue;
      if (!(products[j] + doubt * bound > needed[j])) return SeparationProof::not_found;
      result = SeparationProof::near;
    }
  }
  return result;
}

}  // namespace

// Bound. The weights sum to 1 within 4 u and are at least -u, so a point of the hull, with the same
// weights made positive and divided by their sum, is within 7 u size[k] of the weighted sum. The
// sum is computed with 4 roundings of numbers of at most size[k], and the corners are wrong by 3.01
// u size[k] + 2^-1072. That is below 16 u size[k] a coordinate; the length is wrong by at most the
// sum of these, and by 2.6 u of itself, at most 2.7 u times the sum of the sizes. Underflow of
// squares changes the length by less than 2^-500.
detector::Decision near_in_double(const DoubleReach& reach, double t, double slack) {
  const Vector<double> p = nearest_to_origin(reach.hull.at(t)).point;
  const auto& size = reach.hull.size;
  const double bound = 24 * 0x1p-53 * (size[0] + size[1] + size[2]) + 0x1p-500;
  const double length = std::sqrt(inner(p, p));
  if (length + bound <= reach.least) return detector::Decision::yes;
  return length > reach.most + bound + slack ? detector::Decision::no : detector::Decision::open;
}

SeparationProof apart_in_double(const DoubleReach& reach, double s, double e) {
  if (!reach.hull.usable) return SeparationProof::near;
  const Hull<double> at_s = reach.hull.at(s), at_e = reach.hull.at(e);
  bool near = false;
  const auto separates = [&](const Vector<double>& n_s, const Vector<double>& n_e) {
    const SeparationProof found = judged(reach, at_s, at_e, n_s, n_e);
    near = near || found == SeparationProof::near;
    return found == SeparationProof::separated;
  };
  const auto towards = [](const Hull<double>& hull) {
    return unit_vector(nearest_to_origin(hull).point);
  };
  const Vector<double> n_s = towards(at_s), n_e = towards(at_e);
  if (separates(n_s, n_e)) return SeparationProof::separated;
  const Vector<double> n = towards(reach.hull.at(0.5 * s + 0.5 * e));
  if (separates(n, n) || separates(n_s, n_s) || separates(n_e, n_e))
    return SeparationProof::separated;
  return near ? SeparationProof::near : SeparationProof::not_found;
}

namespace {

// The point of a hull that is nearest to the origin, exactly: `direction` is a positive multiple of
// it, and numerator / denominator its squared length.
struct ExactNearest {
  Vector<mpz_class> direction;
  mpz_class numerator, denominator;
};

ExactNearest nearest_of_side(const Vector<mpz_class>& a, const Vector<mpz_class>& b) {
  const Vector<mpz_class> edge = minus(b, a);
  const mpz_class ae = inner(a, edge), ee = inner(edge, edge);
  if (sgn(ae) >= 0) return {a, inner(a, a), 1};
  if (mpz_class(ae + ee) <= 0) return {b, inner(b, b), 1};
  return {minus(times(a, ee), times(edge, ae)), inner(a, a) * ee - ae * ae, ee};
}

// Returns the place where |P + u U + v V| is least over all u and v, if it is unique and in the
// hull.
std::optional<ExactNearest> nearest_of_inside(const Hull<mpz_class>& hull) {
  const auto& p = hull.corner[0];
  const Vector<mpz_class> u = minus(hull.corner[1], p), v = minus(hull.corner[2], p);
  const mpz_class uu = inner(u, u), uv = inner(u, v), vv = inner(v, v);
  const mpz_class pu = inner(p, u), pv = inner(p, v), determinant = uu * vv - uv * uv;
  if (determinant == 0) return std::nullopt;
  const mpz_class share_u = uv * pv - vv * pu, share_v = uv * pu - uu * pv;
  if (share_u < 0 || share_v < 0) return std::nullopt;
  if (hull.corners == 3 ? mpz_class(share_u + share_v) > determinant
                        : share_u > determinant || share_v > determinant) {
    return std::nullopt;
  }
  return ExactNearest{plus(times(p, determinant), plus(times(u, share_u), times(v, share_v))),
                      inner(p, p) * determinant + pu * share_u + pv * share_v, determinant};
}

// Returns the nearest point. The squared length is convex, so it is least on the hull where it is
// least on the plane, if that place is in the hull, or else on a side.
ExactNearest nearest_of(const Hull<mpz_class>& hull) {
  if (auto inside = nearest_of_inside(hull)) return std::move(*inside);
  const auto& c = hull.corner;
  ExactNearest best = nearest_of_side(c[0], c[1]);
  const auto offer = [&](int a, int b) {
    ExactNearest other = nearest_of_side(c[a], c[b]);
    if (other.numerator * best.denominator < best.numerator * other.denominator) {
      best = std::move(other);
    }
  };
  offer(0, 2);
  if (hull.corners == 3) {
    offer(1, 2);
  } else {
    offer(1, 3);
    offer(2, 3);
  }
  return best;
}

// A direction, and an upper bound of its length.
struct Direction {
  Vector<mpz_class> n;
  mpz_class length;
};

// Returns the direction in so many bits that its error, and the excess of the length, are below the
// last bits of the corners and d.
Direction direction_to(const Hull<mpz_class>& hull, std::size_t bits) {
  Direction to{nearest_of(hull).direction, 0};
  std::size_t most = 0;
  for (const auto& x : to.n) {
    if (x != 0) most = std::max(most, mpz_sizeinbase(x.get_mpz_t(), 2));
  }
  for (auto& x : to.n) {
    if (most > bits) mpz_tdiv_q_2exp(x.get_mpz_t(), x.get_mpz_t(), most - bits);
    if (most > 0 && most < bits) x <<= bits - most;
  }
  const mpz_class square = inner(to.n, to.n);
  to.length = sqrt(square);
  if (to.length * to.length < square) ++to.length;
  return to;
}

// Returns whether the two directions separate. For the middle coefficients both get the same
// length: n_s |n_e| and n_e |n_s|.
bool separates(const Hull<mpz_class>& at_s, const Hull<mpz_class>& at_e, const mpz_class& d,
               const Direction& from, const Direction& to) {
  const mpz_class first = d * from.length, last = d * to.length, both = 2 * first * to.length;
  const bool turns = &from != &to;  // else the middle coefficient is the mean of the two others
  for (int i = 0; i < at_s.corners; ++i) {
    if (inner(from.n, at_s.corner[i]) <= first) return false;
    if (inner(to.n, at_e.corner[i]) <= last) return false;
    if (!turns) continue;
    const mpz_class middle =
        inner(from.n, at_e.corner[i]) * to.length + inner(to.n, at_s.corner[i]) * from.length;
    if (middle <= both) return false;
  }
  return true;
}

}  // namespace

std::size_t IntegerReach::bits() const {
  std::size_t most = mpz_sizeinbase(d.get_mpz_t(), 2);
  for (const auto* corners : {&hull.t0.corner, &hull.t1.corner}) {
    for (const auto& corner : *corners) {
      for (const auto& x : corner) most = std::max(most, mpz_sizeinbase(x.get_mpz_t(), 2));
    }
  }
  return most;
}

bool near_in_integers(const IntegerReach& reach, const Fraction& time) {
  const ExactNearest nearest = nearest_of(reach.hull.at(time.p, time.q));
  const mpz_class d = reach.d * static_cast<long>(time.q);
  return nearest.numerator <= d * d * nearest.denominator;
}

bool apart_in_integers(const IntegerReach& reach, std::int64_t k, int depth) {
  const std::int64_t pieces = std::int64_t{1} << depth;
  const Hull<mpz_class> at_s = reach.hull.at(k, pieces), at_e = reach.hull.at(k + 1, pieces);
  const mpz_class d = reach.d * static_cast<long>(pieces);
  const std::size_t bits = 2 * reach.bits() + 128;
  const Direction from = direction_to(at_s, bits), to = direction_to(at_e, bits);
  if (separates(at_s, at_e, d, from, to)) return true;
  const Direction between = direction_to(reach.hull.at(2 * k + 1, 2 * pieces), bits);
  return separates(at_s, at_e, d, between, between) || separates(at_s, at_e, d, from, from) ||
         separates(at_s, at_e, d, to, to);
}

}  // namespace assay::oracle
