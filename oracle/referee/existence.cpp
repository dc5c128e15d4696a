#include "oracle/referee/existence.h"

#include <algorithm>
#include <cmath>

namespace assay::oracle {

namespace {

bool triangle_contains_origin(const Vector<mpz_class>& a, const Vector<mpz_class>& b,
                              const Vector<mpz_class>& c) {
  const Vector<mpz_class> ab = outer(a, b), bc = outer(b, c), ca = outer(c, a);
  // The normal (b-a) x (c-a) is the sum of the three.
  const Vector<mpz_class> normal = plus(plus(ab, bc), ca);
  const bool is_flat = normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
  if (!is_flat) {
    if (inner(normal, a) != 0) return false;
    return inner(normal, ab) >= 0 && inner(normal, bc) >= 0 && inner(normal, ca) >= 0;
  }
  // The triangle is a segment or a point: the union of its three sides.
  auto side_holds = [](const Vector<mpz_class>& x, const Vector<mpz_class>& y,
                       const Vector<mpz_class>& xy) {
    return xy[0] == 0 && xy[1] == 0 && xy[2] == 0 && inner(x, y) <= 0;
  };
  return side_holds(a, b, ab) || side_holds(b, c, bc) || side_holds(c, a, ca);
}

// Returns the corners that play P, P + U and P + V for a base. The corners of a triangle may be
// turned, so that near a guess u + v <= 1 holds with room to spare; a parallelogram stays as it is.
std::array<int, 3> roles(int base) { return {base, (base + 1) % 3, (base + 2) % 3}; }

template <class Number>
struct Frame {
  Vector<Number> p, u, v;
  Frame(const Hull<Number>& hull, int base) {
    const auto r = roles(base);
    p = hull.corner[r[0]];
    u = minus(hull.corner[r[1]], p);
    v = minus(hull.corner[r[2]], p);
  }
};

constexpr int parameter_bits = 58;  // parameters of boxes are multiples of 2^-58
constexpr std::int64_t parameter_one = std::int64_t{1} << parameter_bits;

struct Range {
  std::int64_t lo, hi;
};

// Returns the part of [x - r, x + r] in [0,1], r = 2^-bits.
Range range_about(double x, int bits) {
  const auto centre =
      static_cast<std::int64_t>(std::ldexp(std::clamp(x, 0.0, 1.0), parameter_bits));
  const std::int64_t r = parameter_one >> bits;
  return {std::max<std::int64_t>(centre - r, 0), std::min(centre + r, parameter_one)};
}

// f and the columns of its Jacobian, in integers. The parameters run over [0,1]^3 in units of
// 2^-58.
class IntegerMap {
 public:
  IntegerMap(const IntegerHull& hull, int base) : at_t0_(hull.t0, base), at_t1_(hull.t1, base) {}

  // Returns f times a positive constant.
  Vector<mpz_class> value(std::int64_t t, std::int64_t u, std::int64_t v) const {
    return plus(times(blend(&Frame<mpz_class>::p, t), number(parameter_one)),
                plus(times(blend(&Frame<mpz_class>::u, t), number(u)),
                     times(blend(&Frame<mpz_class>::v, t), number(v))));
  }
  // Returns the rows of the adjugate of the Jacobian at a place, each up to a positive constant
  // common to all places; empty when the Jacobian is singular.
  std::optional<std::array<Vector<mpz_class>, 3>> adjugate(std::int64_t t, std::int64_t u,
                                                           std::int64_t v) const {
    const auto column_u = blend(&Frame<mpz_class>::u, t), column_v = blend(&Frame<mpz_class>::v, t);
    const auto column_t = plus(times(minus(at_t1_.p, at_t0_.p), number(parameter_one)),
                               plus(times(minus(at_t1_.u, at_t0_.u), number(u)),
                                    times(minus(at_t1_.v, at_t0_.v), number(v))));
    const auto row_t = outer(column_u, column_v);
    if (inner(row_t, column_t) == 0) return std::nullopt;
    return std::array{row_t, outer(column_v, column_t), outer(column_t, column_u)};
  }

 private:
  static mpz_class number(std::int64_t x) { return static_cast<long>(x); }
  Vector<mpz_class> blend(Vector<mpz_class> Frame<mpz_class>::*part, std::int64_t t) const {
    return plus(times(at_t0_.*part, number(parameter_one - t)), times(at_t1_.*part, number(t)));
  }

  Frame<mpz_class> at_t0_, at_t1_;
};

// Returns whether the premise of Poincare-Miranda holds on one box.
bool signs_differ_on_opposite_sides(const IntegerMap& map,
                                    const std::array<Vector<mpz_class>, 3>& rows,
                                    const std::array<Range, 3>& box) {
  std::array<Vector<mpz_class>, 8> f;  // bit i of the index: at the upper end of parameter i
  for (unsigned corner = 0; corner < 8; ++corner) {
    auto end = [&](unsigned i) { return (corner >> i & 1U) ? box[i].hi : box[i].lo; };
    f[corner] = map.value(end(0), end(1), end(2));
  }
  for (unsigned i = 0; i < 3; ++i) {
    bool lower_negative = true, lower_positive = true, upper_negative = true, upper_positive = true;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const int sign = sgn(inner(rows[i], f[corner]));
      const bool upper = (corner >> i & 1U) != 0;
      (upper ? upper_negative : lower_negative) &= sign <= 0;
      (upper ? upper_positive : lower_positive) &= sign >= 0;
    }
    if (!(lower_negative && upper_positive) && !(lower_positive && upper_negative)) return false;
  }
  return true;
}

}  // namespace

bool contains_origin(const Hull<mpz_class>& hull) {
  const auto& c = hull.corner;
  if (triangle_contains_origin(c[0], c[1], c[2])) return true;
  return hull.corners == 4 && triangle_contains_origin(c[3], c[2], c[1]);
}

Fraction simplest_fraction(std::int64_t k, int depth) {
  // By continued fractions: the result is the first integer between the ends or, if there is none,
  // the integer part and the reciprocal of the simplest fraction between the reciprocals of the
  // remainders.
  auto simplest = [](auto&& self, std::int64_t a, std::int64_t b, std::int64_t c,
                     std::int64_t d) -> Fraction {  // in [a/b, c/d]
    const std::int64_t whole = a / b;
    if (whole * b == a) return {whole, 1};
    if (c / d > whole) return {whole + 1, 1};
    const Fraction rest = self(self, d, c - whole * d, b, a - whole * b);
    return {whole * rest.p + rest.q, rest.p};
  };
  const std::int64_t pieces = std::int64_t{1} << depth;
  return simplest(simplest, k, pieces, k + 1, pieces);
}

std::optional<Crossing> guess_crossing(const DoubleHull& hull, double s, double e) {
  if (!hull.usable) return std::nullopt;
  double t = 0.5 * s + 0.5 * e;
  const NearestPoint nearest = nearest_to_origin(hull.at(t));
  Crossing guess;
  if (hull.t0.corners == 3) {
    guess.base =
        static_cast<int>(std::max_element(nearest.weight.begin(), nearest.weight.begin() + 3) -
                         nearest.weight.begin());
  }
  const auto r = roles(guess.base);
  const double opposite = hull.t0.corners == 4 ? nearest.weight[3] : 0;
  double u = nearest.weight[r[1]] + opposite, v = nearest.weight[r[2]] + opposite;
  const Frame<double> at_t0(hull.t0, guess.base), at_t1(hull.t1, guess.base);
  constexpr int most_steps = 24;
  constexpr double small_step = 0x1p-46, far_outside = 4;
  for (int step = 0; step < most_steps; ++step) {
    const Frame<double> now(hull.at(t), guess.base);
    const auto f = plus(now.p, plus(times(now.u, u), times(now.v, v)));
    const auto f_t = plus(minus(at_t1.p, at_t0.p), plus(times(minus(at_t1.u, at_t0.u), u),
                                                        times(minus(at_t1.v, at_t0.v), v)));
    const auto row_t = outer(now.u, now.v);
    const double det = inner(row_t, f_t);
    const double dt = -inner(row_t, f) / det, du = -inner(outer(now.v, f_t), f) / det,
                 dv = -inner(outer(f_t, now.u), f) / det;
    t += dt;
    u += du;
    v += dv;
    const double change = std::fabs(dt) + std::fabs(du) + std::fabs(dv);
    if (!(std::fabs(t) + std::fabs(u) + std::fabs(v) < far_outside)) return std::nullopt;
    if (change > small_step) continue;
    constexpr double slack = 0x1p-30;
    const double most = hull.t0.corners == 4 ? 2 : 1;
    if (t < -slack || t > 1 + slack || u < -slack || v < -slack || u > 1 + slack || v > 1 + slack ||
        u + v > most + slack) {
      return std::nullopt;
    }
    guess.t = t;
    guess.u = u;
    guess.v = v;
    return guess;
  }
  return std::nullopt;
}

bool crossing_in_a_box(const IntegerHull& hull, const Crossing& guess, double until) {
  const IntegerMap map(hull, guess.base);
  const auto middle = [](double x) { return range_about(x, parameter_bits).lo; };
  const auto rows = map.adjugate(middle(guess.t), middle(guess.u), middle(guess.v));
  if (!rows) return false;
  const auto last = static_cast<std::int64_t>(std::ldexp(until, parameter_bits));
  // A large box allows a poor guess, a small one a strongly curved map.
  for (const int bits : {6, 12, 20, 27, 34, 42}) {
    const std::array<Range, 3> box = {range_about(guess.t, bits), range_about(guess.u, bits),
                                      range_about(guess.v, bits)};
    if (box[0].hi > last) continue;
    if (hull.t0.corners == 3 && box[1].hi + box[2].hi > parameter_one) continue;
    if (signs_differ_on_opposite_sides(map, *rows, box)) return true;
  }
  return false;
}

namespace {

// A hull at both ends of a piece, and twice the hull at its middle. `nearest` is the point of the
// middle hull nearest to the origin, and `motion` how this point moves over the piece.
template <class Number>
struct Piece {
  Hull<Number> s, e, middle;
  Vector<Number> motion;
  Vector<Number> nearest;

  Piece(Hull<Number> at_s, Hull<Number> at_e) : s(std::move(at_s)), e(std::move(at_e)) {
    middle.corners = s.corners;
    for (int i = 0; i < s.corners; ++i) middle.corner[i] = plus(s.corner[i], e.corner[i]);
  }
  // Sets the weights, which decide how good a candidate is, never whether it is right.
  void set_weights(const std::array<Number, 4>& weight) {
    motion = nearest = {Number(0), Number(0), Number(0)};
    for (int i = 0; i < s.corners; ++i) {
      motion = plus(motion, times(minus(e.corner[i], s.corner[i]), weight[i]));
      nearest = plus(nearest, times(middle.corner[i], weight[i]));
    }
  }
};

// Returns the index of the i-th corner around the hull. Its edges join consecutive corners.
int around(int corners, int i) {
  constexpr std::array<int, 4> parallelogram = {0, 1, 3, 2};
  i %= corners;
  return corners == 4 ? parallelogram[i] : i;
}

template <class Number>
Vector<Number> normal_of(const Hull<Number>& h) {
  return outer(minus(h.corner[1], h.corner[0]), minus(h.corner[2], h.corner[0]));
}

// Returns the part of v that is perpendicular to w, times |w|^2.
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

// Returns whether the Bernstein coefficients are positive, as far as comparison with `bound` proves
// it. 1: all surely are, -1: one surely is not, 0: neither is sure.
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
// so 8 u S, itself computed with less than 8 roundings, is enough. Underflow adds less than
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

SeparationProof separated_in_double(const DoubleHull& hull, double s, double e) {
  if (!hull.usable) return SeparationProof::near;
  Piece<double> piece(hull.at(s), hull.at(e));
  piece.set_weights(nearest_to_origin(piece.middle).weight);
  bool near = false;
  const bool found =
      some_direction(piece, [&](const Vector<double>& n_s, const Vector<double>& n_e) {
        const int verdict = judge(hull, piece, n_s, n_e);
        near |= verdict == 0;
        return verdict == 1;
      });
  return found  ? SeparationProof::separated
         : near ? SeparationProof::near
                : SeparationProof::not_found;
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
