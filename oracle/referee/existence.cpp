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

// The corners that play P, P + U and P + V for a base. Those of a triangle may be turned, so that
// near a guess u + v <= 1 holds with room to spare; a parallelogram stays as it is.
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

// The part of [x - r, x + r] in [0,1], r = 2^-bits.
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

  // f times a positive constant.
  Vector<mpz_class> value(std::int64_t t, std::int64_t u, std::int64_t v) const {
    return plus(times(blend(&Frame<mpz_class>::p, t), number(parameter_one)),
                plus(times(blend(&Frame<mpz_class>::u, t), number(u)),
                     times(blend(&Frame<mpz_class>::v, t), number(v))));
  }
  // Rows of the adjugate of the Jacobian at a place, each up to a positive constant common to all
  // places; empty when the Jacobian is singular.
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

// The premise of Poincare-Miranda on one box.
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
  // the integer part and the reciprocal of the simplest fraction between the reciprocals of what
  // is left.
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
  // Large boxes forgive a poor guess, small ones a strongly curved map.
  for (const int bits : {6, 12, 20, 27, 34, 42}) {
    const std::array<Range, 3> box = {range_about(guess.t, bits), range_about(guess.u, bits),
                                      range_about(guess.v, bits)};
    if (std::ldexp(static_cast<double>(box[0].hi), -parameter_bits) > until) continue;
    if (hull.t0.corners == 3 && box[1].hi + box[2].hi > parameter_one) continue;
    if (signs_differ_on_opposite_sides(map, *rows, box)) return true;
  }
  return false;
}

}  // namespace assay::oracle
