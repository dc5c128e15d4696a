#include "oracle/referee/separation.h"

#include <algorithm>
#include <cmath>

namespace assay::oracle {

namespace {

// A hull at both ends of a piece, and twice the hull at its middle. `nearest` is the point of that
// which is nearest to the origin, and `motion` how this point moves over the piece.
template <class Number>
struct Piece {
  Hull<Number> s, e, middle;
  Vector<Number> motion;
  Vector<Number> nearest;

  Piece(Hull<Number> at_s, Hull<Number> at_e) : s(std::move(at_s)), e(std::move(at_e)) {
    middle.corners = s.corners;
    for (int i = 0; i < s.corners; ++i) middle.corner[i] = plus(s.corner[i], e.corner[i]);
  }
  // The weights decide how good a candidate is, never whether it is right.
  void set_weights(const std::array<Number, 4>& weight) {
    motion = nearest = {Number(0), Number(0), Number(0)};
    for (int i = 0; i < s.corners; ++i) {
      motion = plus(motion, times(minus(e.corner[i], s.corner[i]), weight[i]));
      nearest = plus(nearest, times(middle.corner[i], weight[i]));
    }
  }
};

// The corners around the hull, in order: consecutive ones are its edges.
int around(int corners, int i) {
  constexpr std::array<int, 4> parallelogram = {0, 1, 3, 2};
  i %= corners;
  return corners == 4 ? parallelogram[i] : i;
}

template <class Number>
Vector<Number> normal_of(const Hull<Number>& h) {
  return outer(minus(h.corner[1], h.corner[0]), minus(h.corner[2], h.corner[0]));
}

// The part of v that is perpendicular to w, times |w|^2.
template <class Number>
Vector<Number> perpendicular(const Vector<Number>& v, const Vector<Number>& w) {
  return minus(times(v, inner(w, w)), times(w, inner(w, v)));
}

// Offers candidates until one is accepted. They serve these cases:
//   nearest point       - the hull is far away compared with its motion;
//   vertex, edge, face  - the nearest point lies there; its best direction, turning along;
//   edge x motion       - an edge passes the origin closely; if a vertex does, the motion's
//                         perpendicular.
template <class Number, class Accept>
bool some_direction(const Piece<Number>& p, const Accept& accept) {
  if (accept(p.nearest, p.nearest)) return true;
  const auto face_middle = normal_of(p.middle);
  if (accept(face_middle, face_middle)) return true;
  if (accept(normal_of(p.s), normal_of(p.e))) return true;
  const int n = p.s.corners;
  for (int i = 0; i < n; ++i) {
    const int a = around(n, i), b = around(n, i + 1);
    const auto edge_s = minus(p.s.corner[b], p.s.corner[a]);
    const auto edge_e = minus(p.e.corner[b], p.e.corner[a]);
    const auto edge = plus(edge_s, edge_e);
    const auto across = outer(edge, p.motion);
    if (accept(across, across)) return true;
    if (accept(outer(edge_s, p.motion), outer(edge_e, p.motion))) return true;
    const auto to_edge = perpendicular(p.middle.corner[a], edge);
    if (accept(to_edge, to_edge)) return true;
    if (accept(perpendicular(p.s.corner[a], edge_s), perpendicular(p.e.corner[a], edge_e))) {
      return true;
    }
    const auto aside = perpendicular(p.middle.corner[a], p.motion);
    if (accept(aside, aside)) return true;
    if (accept(p.middle.corner[a], p.middle.corner[a])) return true;
    if (accept(p.s.corner[a], p.e.corner[a])) return true;
  }
  return false;
}

// Whether the Bernstein coefficients are positive, as far as comparison with `bound` proves it. 1:
// all surely are, -1: one surely is not, 0: neither is sure.
int all_positive(const Piece<double>& p, const Vector<double>& n_s, const Vector<double>& n_e,
                 double bound) {
  int result = 1;
  for (int i = 0; i < p.s.corners; ++i) {
    const double first = inner(n_s, p.s.corner[i]);
    const double last = inner(n_e, p.e.corner[i]);
    const double middle = inner(n_s, p.e.corner[i]) + inner(n_e, p.s.corner[i]);
    const double least = std::min({first, last, middle});
    if (!(least > -bound)) return -1;
    if (!(least > bound)) result = 0;
  }
  return result;
}

// Judges one candidate in double. The direction itself may be anything; only its products with the
// corners must be right.
//
// Bound. Corner coordinates at t0 and t1 have one rounding; c(t) = c0 (1-t) + c1 t, with 1 - t
// exact, adds a product and a sum: at most (1+u)^3 - 1 < 3.01 u, relative to size[k]. The product
// with n_k adds u, the two sums of an inner product 2 u, the sum of two inner products u: below
// 7.1 u in all, relative to
//     S = sum over k of (|n_s[k]| + |n_e[k]|) size[k],
// so 8 u S, itself computed with less than 8 roundings, is enough. What underflow adds is below
// 2^-1065: after n is scaled so that its largest component is in [1/2,1], S >= 2^-901, and the
// spare 0.9 u S >= 2^-955 covers it. Nothing overflows, as sizes and components are at most 1.
int judge(const DoubleHull& hull, const Piece<double>& p, Vector<double> n_s, Vector<double> n_e) {
  double largest = 0;
  for (int k = 0; k < 3; ++k) {
    largest = std::max({largest, std::fabs(n_s[k]), std::fabs(n_e[k])});
  }
  if (!(largest > 0)) return -1;
  int exponent = 0;
  std::frexp(largest, &exponent);
  double scale_sum = 0;
  for (int k = 0; k < 3; ++k) {
    n_s[k] = std::ldexp(n_s[k], -exponent);
    n_e[k] = std::ldexp(n_e[k], -exponent);
    scale_sum += (std::fabs(n_s[k]) + std::fabs(n_e[k])) * hull.size[k];
  }
  const double bound = 8 * 0x1p-53 * scale_sum;
  if (inner(n_s, p.s.corner[0]) < 0) {
    for (int k = 0; k < 3; ++k) {
      n_s[k] = -n_s[k];
      n_e[k] = -n_e[k];
    }
  }
  return all_positive(p, n_s, n_e, bound);
}

bool separates(const Piece<mpz_class>& p, const Vector<mpz_class>& n_s,
               const Vector<mpz_class>& n_e) {
  const bool constant = &n_s == &n_e;
  const int side = sgn(inner(n_s, p.s.corner[0]));
  if (side == 0) return false;
  for (int i = 0; i < p.s.corners; ++i) {
    if (i > 0 && sgn(inner(n_s, p.s.corner[i])) != side) return false;
    if (sgn(inner(n_e, p.e.corner[i])) != side) return false;
    if (constant) continue;  // then the middle coefficient is the sum of the other two
    const mpz_class middle = inner(n_s, p.e.corner[i]) + inner(n_e, p.s.corner[i]);
    if (sgn(middle) != side) return false;
  }
  return true;
}

}  // namespace

Separation separated_in_double(const DoubleHull& hull, double s, double e) {
  if (!hull.usable) return Separation::near;
  Piece<double> piece(hull.at(s), hull.at(e));
  piece.set_weights(nearest_to_origin(piece.middle).weight);
  bool near = false;
  const bool found =
      some_direction(piece, [&](const Vector<double>& n_s, const Vector<double>& n_e) {
        const int verdict = judge(hull, piece, n_s, n_e);
        near |= verdict == 0;
        return verdict == 1;
      });
  return found ? Separation::separated : near ? Separation::near : Separation::not_found;
}

bool separated_in_integers(const IntegerHull& hull, std::int64_t k, int depth) {
  const std::int64_t pieces = std::int64_t{1} << depth;
  Piece<mpz_class> piece(hull.at(k, pieces), hull.at(k + 1, pieces));
  std::array<mpz_class, 4> weight;
  const NearestPoint nearest = nearest_to_origin(rounded(piece.middle));
  for (int i = 0; i < piece.s.corners; ++i) {
    weight[i] = static_cast<long>(std::lround(std::ldexp(nearest.weight[i], 30)));
  }
  piece.set_weights(weight);
  return some_direction(piece, [&](const Vector<mpz_class>& n_s, const Vector<mpz_class>& n_e) {
    return separates(piece, n_s, n_e);
  });
}

}  // namespace assay::oracle
