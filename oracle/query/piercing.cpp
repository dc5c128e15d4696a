// segment_pierces_triangle: signs of 3x3 determinants, by intervals and then by integers.
#include <CGAL/Interval_nt.h>

#include "oracle/processor_state.h"
#include "oracle/query/contact.h"
#include "oracle/query/integer_polynomial.h"
#include "oracle/query/interval_sign.h"

namespace assay::oracle {

namespace {

using detector::MovingPoint;
using detector::Point;
using Interval = CGAL::Interval_nt<false>;

// The five points of the question, all at rest.
struct Configuration {
  std::array<MovingPoint, 5> x;  // e0, e1, f0, f1, f2
};

template <class Number>
Number determinant(const Vector3<Number>& a, const Vector3<Number>& b, const Vector3<Number>& c) {
  const Number x = b[1] * c[2] - b[2] * c[1];
  const Number y = b[2] * c[0] - b[0] * c[2];
  const Number z = b[0] * c[1] - b[1] * c[0];
  return a[0] * x + a[1] * y + a[2] * z;
}

// Calls sign(a, b, c, d), the orientation of four of the points, until the answer is known: 1 yes,
// 0 no, -1 when an orientation of the given precision is not certain. A sign is 2 when uncertain.
template <class Orientation>
int pierces(const Orientation& sign) {
  constexpr int uncertain = 2;
  constexpr int e0 = 0, e1 = 1, f0 = 2, f1 = 3, f2 = 4;
  const int side_0 = sign(f0, f1, f2, e0), side_1 = sign(f0, f1, f2, e1);
  if (side_0 == uncertain || side_1 == uncertain) return -1;
  if (side_0 * side_1 >= 0) return 0;
  const int s01 = sign(e0, e1, f0, f1), s12 = sign(e0, e1, f1, f2);
  if (s01 == uncertain || s12 == uncertain) return -1;
  if (s01 == 0 || s01 != s12) return 0;
  const int s20 = sign(e0, e1, f2, f0);
  if (s20 == uncertain) return -1;
  return s20 == s01 ? 1 : 0;
}

// Not inlined, because it rounds upward while it runs.
[[gnu::noinline]] int pierces_by_intervals(const Configuration& c) {
  const Interval::Protector round_upward;
  return pierces([&](int o, int a, int b, int d) {
    auto edge = [&](int i) {
      Vector3<Interval> v;
      for (int k = 0; k < 3; ++k) v[k] = Interval(c.x[i].t0[k]) - Interval(c.x[o].t0[k]);
      return v;
    };
    const Interval value = determinant(edge(a), edge(b), edge(d));
    const int s = sure_sign(value);
    if (s != 0) return s;
    return value.inf() == 0 && value.sup() == 0 ? 0 : 2;
  });
}

int pierces_by_integers(const Configuration& c) {
  const IntegerScale scale(c.x);
  return pierces([&](int o, int a, int b, int d) {
    auto edge = [&](int i) {
      Vector3<Integer> v;
      for (int k = 0; k < 3; ++k) v[k] = scale(c.x[i].t0[k]) - scale(c.x[o].t0[k]);
      return v;
    };
    return sgn(determinant<Integer>(edge(a), edge(b), edge(d)));
  });
}

}  // namespace

bool segment_pierces_triangle(const Point& e0, const Point& e1, const std::array<Point, 3>& face) {
  require_exact_processor_state();
  const Configuration c = {
      {{{e0, e0}, {e1, e1}, {face[0], face[0]}, {face[1], face[1]}, {face[2], face[2]}}}};
  constexpr double safe_from_overflow = 0x1p300;  // products of three differences stay below 2^910
  const int quick = all_coordinates_below(c.x, safe_from_overflow) ? pierces_by_intervals(c) : -1;
  return (quick >= 0 ? quick : pierces_by_integers(c)) == 1;
}

}  // namespace assay::oracle
