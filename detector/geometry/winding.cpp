// Along a ray the winding number drops by 1 where the ray crosses a triangle in the direction of
// its normal, and it is 0 far out on the ray. So w(origin) is the sum, over the triangles crossed,
// of the sign of ray . normal. If a ray meets an edge or a corner, the next direction is tried.
//
// All rays of a call have the same direction r or its opposite, so that one pass over the triangles
// serves all rays. Projected along r, a ray is a point of a plane, and the ray can meet only
// triangles whose projected boxes contain this point. The coordinates in the plane are
//   u = (r1 x - r0 y) 2^-20, v = (r2 x - r0 z) 2^-20,
// which are constant along r; the factor 2^-20 keeps them finite. Rounding: let `reach` be the
// largest |r_k|, let X, Y, Z be the largest coordinates, and let S = reach 2^-20 (X + Y + Z). Two
// products and a difference are off by less than 2.1 u S + 2^-1074. The coordinate of a ray's
// origin, (2 u0 + u1 + u2) / 4, has two more sums and a quarter, and is off by less than 4 u S +
// 2^-1073. So boxes with a margin of 8 u S + 2^-1071 reject no triangle that the ray meets.
// crossing_signs decides the triangles that are not rejected.

#include "detector/geometry/winding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "detector/exact/bernstein.h"
#include "detector/exact/polynomial.h"

namespace assay::detector {
namespace {

constexpr int reach = 1000;

// The work on a triangle (its size, one cast) and on a ray (one aim), in box tests.
constexpr std::uint64_t work_of_size = 1, work_of_cast = 2, work_of_aim = 10;

// Returns the n-th direction to try, from a fixed recurrence. It is the same on every machine, and
// unlikely to be parallel to many edges.
RayDirection direction_number(int n) {
  std::uint32_t state = 0x9e3779b9u * static_cast<std::uint32_t>(n + 1);
  RayDirection r{};
  for (int& component : r) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    component = static_cast<int>(state % (2 * reach + 1)) - reach;
  }
  return r;
}

struct Shadow {
  double u, v;
};

// The plane seen along a direction.
class Plane {
 public:
  explicit Plane(const RayDirection& r) {
    for (std::size_t k = 0; k < 3; ++k) r_[k] = std::ldexp(r[k], -20);
  }
  Shadow of(const Point& p) const {
    return {r_[1] * p[0] - r_[0] * p[1], r_[2] * p[0] - r_[0] * p[2]};
  }
  Shadow of(const RayOrigin& o) const {
    const Shadow a = of(o[0]), b = of(o[1]), c = of(o[2]);
    return {(2 * a.u + b.u + c.u) * 0.25, (2 * a.v + b.v + c.v) * 0.25};
  }

 private:
  std::array<double, 3> r_{};
};

struct Ray {
  RayOrigin origin;
  std::int32_t outward_of = -1;  // the triangle whose outside is asked for
  std::optional<int> winding;

  // The findings of the direction that is tried at present.
  Shadow shadow{};
  bool reversed = false, met_edge = false, on_surface = false;
  int sum = 0;
};

// The surface, and the pass over its triangles that answers rays.
class Crossings {
 public:
  Crossings(const Topology& mesh, std::span<const std::int32_t> triangles, const PositionsView& x,
            Arithmetic arithmetic, PacedStop* pace)
      : mesh_(mesh), triangles_(triangles), x_(x), arithmetic_(arithmetic), pace_(pace) {
    Point largest = {0, 0, 0};
    for_each_paced(triangles.size(), work_of_size, pace_, [&](std::size_t i) {
      for (const auto& corner : corners(triangles_[i])) {
        for (std::size_t k = 0; k < 3; ++k) largest[k] = std::max(largest[k], std::abs(corner[k]));
      }
    });
    constexpr double scale = 0x1p-20 * reach;
    const double size = largest[0] * scale + largest[1] * scale + largest[2] * scale;
    margin_ = 8 * unit_roundoff * size + 0x1p-1071;
  }

  std::array<Point, 3> corners(std::int32_t t) const {
    const auto& v = mesh_.triangles[static_cast<std::size_t>(t)];
    return {point_of(x_, v[0]), point_of(x_, v[1]), point_of(x_, v[2])};
  }

  bool was_stopped() const { return pace_ && pace_->stopped(); }

  // Finds the winding numbers of those rays that direction r can answer. Rays that need another
  // direction stay in `rays`.
  void answer(const RayDirection& r, std::vector<Ray*>& rays) const {
    std::vector<Ray*> tried;
    const Plane plane(r);
    for (Ray* ray : rays) {
      if (pace_ && pace_->after(work_of_aim)) return;
      ray->met_edge = !aim(r, *ray);
      if (ray->met_edge) continue;
      ray->shadow = plane.of(ray->origin);
      tried.push_back(ray);
    }
    std::sort(tried.begin(), tried.end(),
              [](const Ray* a, const Ray* b) { return a->shadow.u < b->shadow.u; });
    const auto cast_one = [&](std::size_t i) { cast(r, plane, triangles_[i], tried); };
    if (!for_each_paced(triangles_.size(), work_of_cast, pace_, cast_one)) return;
    for (Ray* ray : tried) {
      if (!ray->met_edge && !ray->on_surface) ray->winding = ray->sum;
    }
    std::erase_if(rays, [](const Ray* ray) { return !ray->met_edge || ray->on_surface; });
  }

 private:
  // Points the ray along r or against it. Returns false if r does not serve. A ray that asks for a
  // triangle's outside leaves strictly on the side of its normal; the triangle's own corners give r
  // . normal as the sum of the three (equal) signs.
  bool aim(const RayDirection& r, Ray& ray) const {
    ray.sum = 0;
    ray.reversed = false;
    if (ray.outward_of < 0) return true;
    const auto s = crossing_signs(corners(ray.outward_of), ray.origin, r, arithmetic_);
    ray.reversed = s[0] < 0;
    return s[0] != 0 && s[0] == s[1] && s[1] == s[2];
  }

  void cast(const RayDirection& r, const Plane& plane, std::int32_t t,
            const std::vector<Ray*>& tried) const {
    const auto triangle = corners(t);
    const Shadow a = plane.of(triangle[0]), b = plane.of(triangle[1]), c = plane.of(triangle[2]);
    const double u_lo = std::min({a.u, b.u, c.u}) - margin_;
    const double u_hi = std::max({a.u, b.u, c.u}) + margin_;
    const double v_lo = std::min({a.v, b.v, c.v}) - margin_;
    const double v_hi = std::max({a.v, b.v, c.v}) + margin_;
    auto next = std::lower_bound(tried.begin(), tried.end(), u_lo,
                                 [](const Ray* ray, double u) { return ray->shadow.u < u; });
    for (; next != tried.end() && (*next)->shadow.u <= u_hi; ++next) {
      Ray& ray = **next;
      if (ray.shadow.v < v_lo || ray.shadow.v > v_hi || ray.outward_of == t || ray.met_edge ||
          ray.on_surface) {
        continue;
      }
      cross(t, crossing_signs(triangle, ray.origin, r, arithmetic_), ray);
    }
  }

  void cross(std::int32_t t, const CrossingSigns& s, Ray& ray) const {
    const bool some_positive = s[0] > 0 || s[1] > 0 || s[2] > 0;
    const bool some_negative = s[0] < 0 || s[1] < 0 || s[2] < 0;
    if (some_positive && some_negative) return;  // the line passes by
    const bool all_zero = s[0] == 0 && s[1] == 0 && s[2] == 0;
    // A triangle of zero area is passed over. If it is a segment that the line meets, the line
    // meets an edge of a neighbour too, which rules the direction out. A triangle that is only a
    // point would rule out every direction.
    if (all_zero && sure_of_zero_area(t)) return;
    // The line is not parallel to the triangle's plane, and the origin lies in that plane. So the
    // origin is the place where the line meets the triangle, perhaps at an edge, and every other
    // direction would meet that edge too.
    if (arithmetic_ == Arithmetic::exact && !all_zero && s[3] == 0) {
      ray.on_surface = true;
    } else if (s[0] == 0 || s[1] == 0 || s[2] == 0) {
      ray.met_edge = true;
    } else if (s[3] == 0) {
      ray.on_surface = true;
    } else if (s[3] == (ray.reversed ? -s[0] : s[0])) {
      ray.sum += s[3];
    }
  }

  bool sure_of_zero_area(std::int32_t t) const {
    return arithmetic_ == Arithmetic::exact ? has_zero_area(mesh_, x_, t)
                                            : has_equal_corners(mesh_, x_, t);
  }

  const Topology& mesh_;
  std::span<const std::int32_t> triangles_;
  const PositionsView& x_;
  Arithmetic arithmetic_;
  PacedStop* pace_;
  double margin_ = 0;
};

void count_crossings(const Crossings& surface, std::vector<Ray>& rays, Arithmetic arithmetic) {
  const int directions = arithmetic == Arithmetic::exact ? 100 : 16;
  std::vector<Ray*> open;
  for (Ray& ray : rays) open.push_back(&ray);
  for (int n = 0; n < directions && !open.empty() && !surface.was_stopped(); ++n)
    surface.answer(direction_number(n), open);
}

}  // namespace

bool has_zero_area(const Topology& mesh, const PositionsView& x, std::int32_t triangle) {
  const auto& v = mesh.triangles[static_cast<std::size_t>(triangle)];
  std::array<double, 9> values;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) values[3 * i + k] = x(v[i], static_cast<Eigen::Index>(k));
  }
  std::array<Integer, 9> p;
  to_common_integers(values, p);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Integer normal =
        (p[3 + i] - p[i]) * (p[6 + j] - p[j]) - (p[3 + j] - p[j]) * (p[6 + i] - p[i]);
    if (!normal.is_zero()) return false;
  }
  return true;
}

bool has_equal_corners(const Topology& mesh, const PositionsView& x, std::int32_t triangle) {
  const auto& v = mesh.triangles[static_cast<std::size_t>(triangle)];
  const Point a = point_of(x, v[0]), b = point_of(x, v[1]), c = point_of(x, v[2]);
  return a == b || b == c || c == a;
}

std::optional<int> winding_number(const Topology& mesh, std::span<const std::int32_t> triangles,
                                  const PositionsView& x, const Point& point, Arithmetic arithmetic,
                                  PacedStop* pace) {
  std::vector<Ray> ray(1);
  ray[0].origin = {point, point, point};
  count_crossings({mesh, triangles, x, arithmetic, pace}, ray, arithmetic);
  return ray[0].winding;
}

std::vector<std::optional<int>> winding_numbers_outside(const Topology& mesh,
                                                        std::span<const std::int32_t> triangles,
                                                        const PositionsView& x,
                                                        std::span<const std::int32_t> queries,
                                                        Arithmetic arithmetic, PacedStop* pace) {
  const Crossings surface(mesh, triangles, x, arithmetic, pace);
  std::vector<Ray> rays(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    rays[i].origin = surface.corners(queries[i]);
    rays[i].outward_of = queries[i];
  }
  count_crossings(surface, rays, arithmetic);
  std::vector<std::optional<int>> winding;
  for (const Ray& ray : rays) winding.push_back(ray.winding);
  return winding;
}

// Coordinates are taken 4 times as large, so that the origin o = (2 p0 + p1 + p2) / 4, a point
// inside a triangle, is exact as well.
//
// Error bounds of the filter, in the notation of bernstein.h. The determinant's entries are those
// of A = 4 (a - o); W_k is the largest |a_k - p_k| involved. V is the product of the sizes 4 W_k
// of the three entries of a term.
//
//   quantity       | operations                         | error in u               | size
//   a - p0, ...    | differences of two doubles         | 1 W                      | W
//   A_k            | 2 (a - p0) + (a - p1) + (a - p2)   | 4 + 3 + 4 = 11 W         | 4 W
//   minor          | x y - z w                          | 1 + 1 + 2 = 4 V          | 2 V
//   term           | an entry times a minor             | 4 + 2 = 6 V              | 2 V
//   determinant    | three terms, two sums              | 3 * 6 + 4 + 6 = 28 V     | 6 V
//   its entries    | 6 products of 3 entries            | 6 * 3 * 11 / 4 = 49.5 V  | 6 V
//
// The rows of minor, term and determinant count roundings alone. The last row adds the error of the
// determinant that comes from the errors of its entries: 11 W is 11 / 4 u of an entry's size 4 W.
// Together these are 77.5 u V. The code asks for 80 u V, which also covers errors of second order
// and the rounding of V. A ray's direction is exact.
//
// If the filter cannot tell a sign, exact arithmetic computes it in integers. Bounded arithmetic
// leaves the sign 0. Then the direction is given up, or the count altogether, but nothing is
// counted wrongly.

namespace {

constexpr double least_size = 0x1p-290, greatest_size = 0x1p290;

template <class T>
T determinant(const std::array<T, 3>& a, const std::array<T, 3>& b, const std::array<T, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

template <class T>
std::array<T, 4> determinants(const std::array<std::array<T, 3>, 3>& corners,
                              const std::array<T, 3>& r) {
  const auto& [a, b, c] = corners;
  return {determinant(a, b, r), determinant(b, c, r), determinant(c, a, r), determinant(a, b, c)};
}

CrossingSigns exact_signs(const std::array<Point, 3>& corners, const RayOrigin& o,
                          const RayDirection& r) {
  std::array<double, 18> values;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      values[3 * i + k] = corners[i][k];
      values[9 + 3 * i + k] = o[i][k];
    }
  }
  std::array<Integer, 18> x;
  to_common_integers(values, x);
  std::array<std::array<Integer, 3>, 3> from_origin;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      from_origin[i][k] = 4 * x[3 * i + k] - 2 * x[9 + k] - x[12 + k] - x[15 + k];
    }
  }
  CrossingSigns signs{};
  const auto dets =
      determinants<Integer>(from_origin, {Integer(r[0]), Integer(r[1]), Integer(r[2])});
  for (std::size_t i = 0; i < signs.size(); ++i) signs[i] = dets[i].sign();
  return signs;
}

// Returns the signs by doubles. A sign is 0 if they cannot tell it, or in plain numbers if the
// computed determinant is 0.
template <class Bounds>
CrossingSigns filtered_signs(const std::array<Point, 3>& corners, const RayOrigin& o,
                             const RayDirection& r) {
  using Number = typename Bounds::Number;
  std::array<VectorOf<Number>, 3> a{};
  VectorOf<Number> w = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = static_cast<Number>(corners[i][k]);
      const Number d0 = x - static_cast<Number>(o[0][k]), d1 = x - static_cast<Number>(o[1][k]),
                   d2 = x - static_cast<Number>(o[2][k]);
      a[i][k] = 2 * d0 + d1 + d2;
      w[k] = std::max({w[k], 4 * std::abs(d0), 4 * std::abs(d1), 4 * std::abs(d2)});
    }
  }
  if constexpr (Bounds::proved) {
    const bool in_range = std::all_of(w.begin(), w.end(),
                                      [](Number m) { return m > least_size && m < greatest_size; });
    if (!in_range) return {};
  }
  const VectorOf<Number> direction = {static_cast<Number>(r[0]), static_cast<Number>(r[1]),
                                      static_cast<Number>(r[2])};
  const VectorOf<Number> extent = {std::abs(direction[0]), std::abs(direction[1]),
                                   std::abs(direction[2])};
  const auto dets = determinants<Number>(a, direction);
  // V is summed by terms, because each coordinate of the (exact) direction has its own size.
  constexpr Number error = 80 * Bounds::unit;
  const Number along =
      error * (w[0] * w[1] * extent[2] + w[1] * w[2] * extent[0] + w[2] * w[0] * extent[1]);
  const Number volume = error * (w[0] * w[1] * w[2]);
  return {sign_beyond(dets[0], along), sign_beyond(dets[1], along), sign_beyond(dets[2], along),
          sign_beyond(dets[3], volume)};
}

}  // namespace

CrossingSigns crossing_signs(const std::array<Point, 3>& corners, const RayOrigin& o,
                             const RayDirection& r, Arithmetic arithmetic) {
  switch (arithmetic) {
    case Arithmetic::bounded:
      return filtered_signs<ProvedBounds>(corners, o, r);
    case Arithmetic::double_precision:
      return filtered_signs<NoBounds<double>>(corners, o, r);
    case Arithmetic::single_precision:
      return filtered_signs<NoBounds<float>>(corners, o, r);
    case Arithmetic::exact:
      break;
  }
  const CrossingSigns signs = filtered_signs<ProvedBounds>(corners, o, r);
  const bool all_known =
      std::all_of(signs.begin(), signs.end(), [](int sign) { return sign != 0; });
  return all_known ? signs : exact_signs(corners, o, r);
}

}  // namespace assay::detector
