// The bounds of the filters hold: every coefficient in doubles is compared with the same
// coefficient in exact integers. Prints the largest error beside the bound.
#include "detector/contact/rungs.h"
#include "detector/view/view_signs.h"
#include "tests/detector/exact/exact_numbers.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

constexpr int cases = 20000;

TEST(ErrorBounds, CoplanarityCubicAndDependencies) {
  Numbers numbers;
  double worst_cubic = 0, worst_quadratic = 0;
  for (int i = 0; i < cases; ++i) {
    numbers.family(i % 4);
    const MovingPoint x[4] = {numbers.point(), numbers.point(), numbers.point(), numbers.point()};
    MovingVector u[3];
    MovingExact e[3];
    Vector m = {0, 0, 0};
    for (int j = 0; j < 3; ++j) {
      u[j] = difference(x[j + 1], x[0]);
      e[j] = exact_difference(x[j + 1], x[0]);
      grow(m, u[j]);
    }
    if (!in_range(m)) continue;
    const CrossQuadratic n = cross(u[1], u[2]);
    const Cubic f = triple_product(u[0], n);
    const ExactVector n0 = cross(e[1].t0, e[2].t0), n2 = cross(e[1].t1, e[2].t1);
    const ExactVector n1_twice = cross(e[1].t0, e[2].t1) + cross(e[1].t1, e[2].t0);
    const double scale = m[0] * m[1] * m[2];
    const double errors[4] = {
        error_units(f[0], dot(e[0].t0, n0), 1, scale),
        error_units(f[1], dot(e[0].t0, n1_twice) + dot(e[0].t1, n0), 3, scale),
        error_units(f[2], dot(e[0].t0, n2) + dot(e[0].t1, n1_twice), 3, scale),
        error_units(f[3], dot(e[0].t1, n2), 1, scale)};
    for (const double error : errors) worst_cubic = std::max(worst_cubic, error);
    // lam_0 is the worst of the quadratics: minus the sum of three.
    const CrossQuadratic a = cross(u[2], u[0]), b = cross(u[0], u[1]);
    const ExactVector sum_twice = n1_twice + cross(e[2].t0, e[0].t1) + cross(e[2].t1, e[0].t0) +
                                  cross(e[0].t0, e[1].t1) + cross(e[0].t1, e[1].t0);
    for (std::size_t k = 0; k < 3; ++k) {
      const double computed = n.b1[k] + a.b1[k] + b.b1[k];
      worst_quadratic = std::max(
          worst_quadratic, error_units(computed, sum_twice[k], 2, m[(k + 1) % 3] * m[(k + 2) % 3]));
    }
  }
  std::printf(
      "%d cases; cubic: %.2f of %.0f allowed, quadratic: %.2f of %.0f allowed (units of 2^-53 "
      "times the scale)\n",
      cases, worst_cubic, cubic_error(0) / unit_roundoff, worst_quadratic,
      quadratic_error(0) / unit_roundoff);
  EXPECT_LT(worst_cubic, cubic_error(0) / unit_roundoff);
  EXPECT_LT(worst_quadratic, quadratic_error(0) / unit_roundoff);
  // Errors were there to be seen.
  EXPECT_GT(worst_cubic, 0.5);
  EXPECT_GT(worst_quadratic, 0.5);
}

TEST(ErrorBounds, ViewCubicAndAxial) {
  Numbers numbers;
  double worst_cubic = 0, worst_axial = 0;
  for (int i = 0; i < cases; ++i) {
    numbers.family(i % 3);
    const MovingPoint p[3] = {numbers.point(), numbers.point(), numbers.point()};
    const MovingPoint q0 = numbers.point(), q1 = numbers.point();
    const MovingVector e1 = difference(p[1], p[0]), e2 = difference(p[2], p[0]),
                       w = difference(p[0], q0), d = difference(q1, q0);
    Vector edge = {0, 0, 0}, reach = {0, 0, 0}, line = {0, 0, 0};
    grow(edge, e1);
    grow(edge, e2);
    grow(reach, w);
    grow(line, d);
    const Cubic h = triple_product(w, cross(e1, e2));
    const MovingExact x1 = exact_difference(p[1], p[0]), x2 = exact_difference(p[2], p[0]),
                      xw = exact_difference(p[0], q0), xd = exact_difference(q1, q0);
    const ExactVector n0 = cross(x1.t0, x2.t0);
    const ExactVector n1_twice = cross(x1.t0, x2.t1) + cross(x1.t1, x2.t0);
    const double scale =
        reach[0] * edge[1] * edge[2] + reach[1] * edge[2] * edge[0] + reach[2] * edge[0] * edge[1];
    worst_cubic = std::max(worst_cubic, error_units(h[0], dot(xw.t0, n0), 1, scale));
    worst_cubic =
        std::max(worst_cubic, error_units(h[1], dot(xw.t0, n1_twice) + dot(xw.t1, n0), 3, scale));
    const Quadratic along = dot(w, d);
    worst_axial = std::max(worst_axial, error_units(along[1], dot(xw.t0, xd.t1) + dot(xw.t1, xd.t0),
                                                    2, detector::dot(reach, line)));
  }
  std::printf("%d cases; view cubic: %.2f of %.0f allowed, axial: %.2f of %.0f allowed\n", cases,
              worst_cubic, view_cubic_error(0) / unit_roundoff, worst_axial,
              view_axial_error(0) / unit_roundoff);
  EXPECT_LT(worst_cubic, view_cubic_error(0) / unit_roundoff);
  EXPECT_LT(worst_axial, view_axial_error(0) / unit_roundoff);
  EXPECT_GT(worst_cubic, 0.5);
  EXPECT_GT(worst_axial, 0.5);
}

TEST(ErrorBounds, HalvingAddsWhatIsAllowed) {
  Numbers numbers;
  double worst = 0;
  for (int i = 0; i < cases; ++i) {
    numbers.family(0);
    Cubic b = {numbers.next(), numbers.next(), numbers.next(), numbers.next()}, left, right;
    halve(b, left, right);
    // Left coefficients: 1; (b0+b1)/2; (b0+2b1+b2)/4; (b0+3b1+3b2+b3)/8, at most max|b| = 1.
    worst = std::max(worst, error_units(left[1], Exact(b[0]) + Exact(b[1]), 2, 1));
    worst = std::max(
        worst, error_units(left[2], Exact(b[0]) + Exact(2) * Exact(b[1]) + Exact(b[2]), 4, 1));
    worst = std::max(
        worst,
        error_units(left[3], Exact(b[0]) + Exact(3) * (Exact(b[1]) + Exact(b[2])) + Exact(b[3]), 8,
                    1));
    EXPECT_EQ(left[3], right[0]);
  }
  std::printf("halving a cubic: %.2f of 3 allowed (units of 2^-53 max|coefficient|)\n", worst);
  EXPECT_LT(worst, 3);
  EXPECT_GT(worst, 0.25);
}

}  // namespace
}  // namespace assay::detector
