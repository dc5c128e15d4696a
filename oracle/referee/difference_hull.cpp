#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "oracle/referee/existence.h"

namespace assay::oracle {

namespace {

using detector::Point;

// Corner i is first[i] - second[i] of the query's points.
struct Corners {
  std::array<const detector::MovingPoint*, 4> first, second;
  int count;
};

Corners corners_of(const detector::FourPoints& q) {
  const auto* x = q.points.data();
  if (q.first_group == 1) return {{x, x, x, x}, {x + 1, x + 2, x + 3, x + 3}, 3};
  return {{x, x + 1, x, x + 1}, {x + 2, x + 2, x + 3, x + 3}, 4};
}

// x = mantissa * 2^exponent with an odd mantissa, or 0.
struct Parts {
  std::int64_t mantissa = 0;
  int exponent = std::numeric_limits<int>::max();
};

Parts parts_of(double x) {
  if (x == 0) return {};
  constexpr int digits = std::numeric_limits<double>::digits;
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), digits));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  return {mantissa / (std::int64_t{1} << zeros), exponent - digits + zeros};
}

mpz_class scaled(double x, int unit) {
  const Parts parts = parts_of(x);
  mpz_class value = static_cast<long>(parts.mantissa);
  if (parts.mantissa != 0) value <<= static_cast<mp_bitcnt_t>(parts.exponent - unit);
  return value;
}

// Returns the nearest point of the triangle of corners a, b, c, by the regions of its vertices and
// edges.
NearestPoint nearest_of_triangle(const Hull<double>& hull, int a, int b, int c) {
  const auto &A = hull.corner[a], &B = hull.corner[b], &C = hull.corner[c];
  const auto ab = minus(B, A), ac = minus(C, A);
  NearestPoint best;
  double least = std::numeric_limits<double>::infinity();
  auto offer = [&](double wa, double wb, double wc) {
    Vector<double> p;
    for (int k = 0; k < 3; ++k) p[k] = wa * A[k] + wb * B[k] + wc * C[k];
    const double distance = inner(p, p);
    if (!(distance < least)) return;
    least = distance;
    best.point = p;
    best.weight = {};
    best.weight[a] = wa;
    best.weight[b] = wb;
    best.weight[c] = wc;
  };
  auto along = [](const Vector<double>& from, const Vector<double>& edge) {
    const double length = inner(edge, edge);
    return length > 0 ? std::clamp(-inner(from, edge) / length, 0.0, 1.0) : 0.0;
  };
  const double s = along(A, ab), t = along(A, ac), r = along(B, minus(C, B));
  offer(1 - s, s, 0);
  offer(1 - t, 0, t);
  offer(0, 1 - r, r);
  const auto normal = outer(ab, ac);
  const double area = inner(normal, normal);
  if (area > 0) {
    const double wb = inner(outer(ac, A), normal) / area, wc = inner(outer(A, ab), normal) / area;
    if (wb >= 0 && wc >= 0 && wb + wc <= 1) offer(1 - wb - wc, wb, wc);
  }
  return best;
}

}  // namespace

DoubleHull double_hull(const detector::FourPoints& query) {
  const Corners c = corners_of(query);
  DoubleHull hull;
  hull.t0.corners = hull.t1.corners = c.count;
  double largest = 0;
  for (int i = 0; i < c.count; ++i) {
    for (int k = 0; k < 3; ++k) {
      hull.t0.corner[i][k] = c.first[i]->t0[k] - c.second[i]->t0[k];
      hull.t1.corner[i][k] = c.first[i]->t1[k] - c.second[i]->t1[k];
      largest =
          std::max({largest, std::fabs(hull.t0.corner[i][k]), std::fabs(hull.t1.corner[i][k])});
    }
  }
  hull.usable = std::isfinite(largest);
  if (!hull.usable) return hull;
  std::frexp(largest, &hull.exponent);
  hull.size.fill(0x1p-900);
  for (int i = 0; i < c.count; ++i) {
    for (int k = 0; k < 3; ++k) {
      for (double* x : {&hull.t0.corner[i][k], &hull.t1.corner[i][k]}) {
        *x = std::ldexp(*x, -hull.exponent);
        hull.size[k] = std::max(hull.size[k], std::fabs(*x));
      }
    }
  }
  return hull;
}

IntegerHull integer_hull(const detector::FourPoints& query) {
  const Corners c = corners_of(query);
  int unit = std::numeric_limits<int>::max();
  for (const auto& point : query.points) {
    for (int k = 0; k < 3; ++k) {
      unit = std::min({unit, parts_of(point.t0[k]).exponent, parts_of(point.t1[k]).exponent});
    }
  }
  IntegerHull hull;
  // All zero: any unit will do.
  if (unit == std::numeric_limits<int>::max()) unit = 0;
  hull.unit = unit;
  hull.t0.corners = hull.t1.corners = c.count;
  for (int i = 0; i < c.count; ++i) {
    for (int k = 0; k < 3; ++k) {
      hull.t0.corner[i][k] = scaled(c.first[i]->t0[k], unit) - scaled(c.second[i]->t0[k], unit);
      hull.t1.corner[i][k] = scaled(c.first[i]->t1[k], unit) - scaled(c.second[i]->t1[k], unit);
    }
  }
  return hull;
}

Hull<double> DoubleHull::at(double t) const {
  Hull<double> hull;
  hull.corners = t0.corners;
  for (int i = 0; i < hull.corners; ++i) {
    for (int k = 0; k < 3; ++k) {
      hull.corner[i][k] = t0.corner[i][k] * (1 - t) + t1.corner[i][k] * t;
    }
  }
  return hull;
}

Hull<mpz_class> IntegerHull::at(std::int64_t p, std::int64_t q) const {
  Hull<mpz_class> hull;
  hull.corners = t0.corners;
  for (int i = 0; i < hull.corners; ++i) {
    for (int k = 0; k < 3; ++k) {
      hull.corner[i][k] = t0.corner[i][k] * static_cast<long>(q - p);
      hull.corner[i][k] += t1.corner[i][k] * static_cast<long>(p);
    }
  }
  return hull;
}

Hull<double> rounded(const Hull<mpz_class>& hull) {
  std::size_t bits = 0;
  for (int i = 0; i < hull.corners; ++i) {
    for (const auto& x : hull.corner[i]) bits = std::max(bits, mpz_sizeinbase(x.get_mpz_t(), 2));
  }
  Hull<double> result;
  result.corners = hull.corners;
  for (int i = 0; i < hull.corners; ++i) {
    for (int k = 0; k < 3; ++k) {
      long exponent = 0;
      const double fraction = mpz_get_d_2exp(&exponent, hull.corner[i][k].get_mpz_t());
      result.corner[i][k] =
          std::ldexp(fraction, static_cast<int>(exponent - static_cast<long>(bits)));
    }
  }
  return result;
}

NearestPoint nearest_to_origin(const Hull<double>& hull) {
  const NearestPoint one = nearest_of_triangle(hull, 0, 1, 2);
  if (hull.corners == 3) return one;
  const NearestPoint two = nearest_of_triangle(hull, 3, 2, 1);
  return inner(one.point, one.point) <= inner(two.point, two.point) ? one : two;
}

}  // namespace assay::oracle
