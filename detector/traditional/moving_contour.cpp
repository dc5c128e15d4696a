// The projection along d. Let m be the axis along which |d| is greatest, let k and l be the other
// two axes in cyclic order, and let s be the sign of d_m. The two coordinates of a projected point
// x are s (d_m x_k - d_k x_m) and d_m x_l - d_l x_m. Both stay the same if x moves along d, and the
// map keeps orientation. A coordinate is computed with one rounding, because its products are
// exact. Rounding keeps order: if two computed coordinates are strictly ordered, the true
// coordinates are too. Points are linear in t: if two coordinates have the same order at t=0 and at
// t=1, they have it throughout.
//
// Error bounds of turns and cosines, in the notation of bernstein.h. x and y are differences of two
// projected points. Their first coordinate is at most M_u = |d_m| M_k + |d_k| M_m in size, where
// M_k and M_m bound the differences in space, and M_v bounds the second coordinate in the same way.
// MM is M_u M_v, and D is M_u^2 + M_v^2.
//
//   quantity         | operations                       | error in u                 | size
//   coordinate x_u   | d_m e_k - d_k e_m                | 1 + 1 = 2 M_u              | M_u
//   turn             | x_u y_v - x_v y_u                | 5 + 5 + 2 = 12 MM          | 2 MM
//   turn, middle     | (turn + turn) / 2                | (12 + 12 + 4) / 2 = 14 MM  | 2 MM
//   turn, halved     | a quadratic with B = 2 MM        | as before + 4 MM           | 2 MM
//   cosine           | x_u y_u + x_v y_v                | 5 + 1 = 6 D                | D
//   cosine, middle   | (cosine + cosine) / 2            | (6 + 6 + 2) / 2 = 7 D      | D
//   cosine, halved   | a quadratic with B = D           | as before + 2 D            | D
//
// A product of two coordinates is off by 2 + 2 (entries) + 1 (rounding) = 5. e is a difference in
// space, off by 1 M, and its products with 1 or 2 are exact. turn_units(depth) is 16, plus 4 for
// each halving. It covers all errors of the table and the rounding of M_u and M_v.

#include "detector/traditional/moving_contour.h"

#include <algorithm>
#include <cmath>

namespace assay::detector {
namespace {

// The work on an edge, in box tests, counted once for each chain of long_chain edges or more that
// holds it. The work on shorter chains is part of that.
constexpr std::uint64_t work_of_edge = 8;
constexpr std::size_t long_chain = 64;

constexpr int max_depth = 3;
constexpr double turn_units(int depth) { return 16 + 4 * depth; }

Quadratic turn(const auto& x, const auto& y) {
  const auto minor = [](const auto& p, const auto& q) { return p[0] * q[1] - p[1] * q[0]; };
  return {minor(x.t0, y.t0), (minor(x.t0, y.t1) + minor(x.t1, y.t0)) / 2, minor(x.t1, y.t1)};
}

Quadratic cosine(const auto& x, const auto& y) {
  const auto product = [](const auto& p, const auto& q) { return p[0] * q[0] + p[1] * q[1]; };
  return {product(x.t0, y.t0), (product(x.t0, y.t1) + product(x.t1, y.t0)) / 2,
          product(x.t1, y.t1)};
}

bool is_in_range(const std::array<double, 2>& magnitude) {
  return in_range({magnitude[0], magnitude[1], 0});
}

// How two edges a and b lie to each other: on which side of a the two ends of b are, and on which
// side of b the two ends of a are. If both ends of one edge are strictly on the same side of the
// other, the edges do not meet. At different times it may be different edges that show this.
struct Sides {
  std::array<Quadratic, 2> of_a, of_b;
};

bool same_side(const std::array<Quadratic, 2>& ends, double bound) {
  const int side = sure_sign(ends[0], bound);
  return side != 0 && side == sure_sign(ends[1], bound);
}

bool are_apart(const Sides& sides, double scale, int depth) {
  const double bound = turn_units(depth) * unit_roundoff * scale;
  if (same_side(sides.of_a, bound) || same_side(sides.of_b, bound)) return true;
  if (depth == max_depth) return false;
  Sides left, right;
  for (std::size_t i = 0; i < 2; ++i) {
    halve(sides.of_a[i], left.of_a[i], right.of_a[i]);
    halve(sides.of_b[i], left.of_b[i], right.of_b[i]);
  }
  return are_apart(left, scale, depth + 1) && are_apart(right, scale, depth + 1);
}

// Returns whether it is proved that two edges that leave a common vertex do not overlap. They
// overlap only if they run in the same direction: then the turn between them is 0 and their cosine
// positive.
bool is_open(const Quadratic& turned, const Quadratic& aligned, double turn_scale,
             double aligned_scale, int depth) {
  const double units = turn_units(depth) * unit_roundoff;
  if (sure_sign(turned, units * turn_scale) != 0 || sure_sign(aligned, units * aligned_scale) < 0)
    return true;
  if (depth == max_depth) return false;
  Quadratic turned_left, turned_right, aligned_left, aligned_right;
  halve(turned, turned_left, turned_right);
  halve(aligned, aligned_left, aligned_right);
  return is_open(turned_left, aligned_left, turn_scale, aligned_scale, depth + 1) &&
         is_open(turned_right, aligned_right, turn_scale, aligned_scale, depth + 1);
}

}  // namespace

bool MovingContour::apart(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 2; ++k) {
    if ((a.hi[k] < b.lo[k] && a.hi[k + 2] < b.lo[k + 2]) ||
        (b.hi[k] < a.lo[k] && b.hi[k + 2] < a.lo[k + 2])) {
      return true;
    }
  }
  return false;
}

void MovingContour::make_boxes(const Chain& chain) {
  const auto join = [](const Box& a, const Box& b) {
    Box box;
    for (std::size_t k = 0; k < 4; ++k) {
      box.lo[k] = std::min(a.lo[k], b.lo[k]);
      box.hi[k] = std::max(a.hi[k], b.hi[k]);
    }
    return box;
  };
  if (chain.count == 1) {
    boxes_[chain.box] = join(points_[chain.first], points_[next(chain.first)]);
    return;
  }
  const Chain a = chain.first_half(), b = chain.second_half();
  make_boxes(a);
  make_boxes(b);
  boxes_[chain.box] = join(boxes_[a.box], boxes_[b.box]);
}

bool MovingContour::stays_simple(Contour contour, int direction_bit) {
  contour_ = contour;
  d_ = direction(direction_bit);
  Eigen::Index m = 0;
  for (Eigen::Index k = 1; k < 3; ++k) {
    if (std::abs(d_[static_cast<std::size_t>(k)]) > std::abs(d_[static_cast<std::size_t>(m)]))
      m = k;
  }
  axis_ = {(m + 1) % 3, (m + 2) % 3, m};
  points_.resize(contour.size());
  boxes_.resize(2 * contour.size());
  const double weight = d_[static_cast<std::size_t>(m)];
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const auto v = contour[i];
    const auto coordinate = [&](const PositionsView& x, std::size_t k) {
      return weight * x(v, axis_[k]) - d_[static_cast<std::size_t>(axis_[k])] * x(v, m);
    };
    const std::array<double, 4> y = {
        coordinate(motion_.vertices_t0, 0), coordinate(motion_.vertices_t0, 1),
        coordinate(motion_.vertices_t1, 0), coordinate(motion_.vertices_t1, 1)};
    // Far out a coordinate may overflow, and the order of infinite ones cannot be trusted.
    if (!std::all_of(y.begin(), y.end(), [](double c) { return std::isfinite(c); })) return false;
    points_[i] = {y, y};
  }
  const Chain all{0, contour.size(), 0};
  make_boxes(all);
  return is_simple(all);
}

bool MovingContour::is_simple(const Chain& chain) const {
  if (chain.count == 1) return true;
  if (pace_ && chain.count >= long_chain && pace_->after(work_of_edge * chain.count)) return false;
  return keeps_apart(chain.first_half(), chain.second_half()) && is_simple(chain.first_half()) &&
         is_simple(chain.second_half());
}

bool MovingContour::keeps_apart(const Chain& a, const Chain& b) const {
  if (apart(boxes_[a.box], boxes_[b.box])) return true;
  if (a.count == 1 && b.count == 1) return edges_keep_apart(a.first, b.first);
  return a.count > b.count ? keeps_apart(a.first_half(), b) && keeps_apart(a.second_half(), b)
                           : keeps_apart(a, b.first_half()) && keeps_apart(a, b.second_half());
}

MovingContour::Flat MovingContour::flat(std::int32_t p, std::int32_t q,
                                        std::array<double, 2>& magnitude) const {
  const MovingVector e = difference(motion_.path(p), motion_.path(q));
  const auto m = static_cast<std::size_t>(axis_[2]);
  Flat out;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(axis_[i]);
    out.t0[i] = d_[m] * e.t0[k] - d_[k] * e.t0[m];
    out.t1[i] = d_[m] * e.t1[k] - d_[k] * e.t1[m];
    const double along = std::max(std::abs(e.t0[k]), std::abs(e.t1[k]));
    const double across = std::max(std::abs(e.t0[m]), std::abs(e.t1[m]));
    magnitude[i] = std::max(magnitude[i], std::abs(d_[m]) * along + std::abs(d_[k]) * across);
  }
  return out;
}

bool MovingContour::edges_keep_apart(std::size_t i, std::size_t j) const {
  if (next(i) == j) return corner_stays_open(j);
  if (next(j) == i) return corner_stays_open(i);
  const auto a0 = contour_[i], a1 = contour_[next(i)], b0 = contour_[j], b1 = contour_[next(j)];
  std::array<double, 2> magnitude = {0, 0};
  const Flat a = flat(a1, a0, magnitude), b = flat(b1, b0, magnitude);
  const Flat b0_a0 = flat(b0, a0, magnitude), b1_a0 = flat(b1, a0, magnitude);
  const Flat a1_b0 = flat(a1, b0, magnitude), a0_b0 = flat(a0, b0, magnitude);
  if (!is_in_range(magnitude)) return false;
  return are_apart({{turn(a, b0_a0), turn(a, b1_a0)}, {turn(b, a0_b0), turn(b, a1_b0)}},
                   magnitude[0] * magnitude[1], 0);
}

bool MovingContour::corner_stays_open(std::size_t i) const {
  const auto v = contour_[i], after = contour_[next(i)];
  const auto before = contour_[i == 0 ? contour_.size() - 1 : i - 1];
  std::array<double, 2> magnitude = {0, 0};
  const Flat x = flat(before, v, magnitude), y = flat(after, v, magnitude);
  if (!is_in_range(magnitude)) return false;
  return is_open(turn(x, y), cosine(x, y), magnitude[0] * magnitude[1],
                 magnitude[0] * magnitude[0] + magnitude[1] * magnitude[1], 0);
}

Vector MovingContour::area(Contour contour) const {
  const auto middle = [&](std::int32_t v) {
    Vector x;
    for (Eigen::Index k = 0; k < 3; ++k) {
      x[static_cast<std::size_t>(k)] =
          (0.5 * motion_.vertices_t0(v, k) + 0.5 * motion_.vertices_t1(v, k)) -
          (0.5 * motion_.vertices_t0(contour[0], k) + 0.5 * motion_.vertices_t1(contour[0], k));
    }
    return x;
  };
  Vector area = {0, 0, 0};
  Vector last = middle(contour[1]);
  for (std::size_t i = 2; i < contour.size(); ++i) {
    const Vector x = middle(contour[i]);
    const Vector n = cross(last, x);
    for (std::size_t k = 0; k < 3; ++k) area[k] += n[k];
    last = x;
  }
  return area;
}

// N(t).d is a quadratic in t and lies between the least and the greatest of its Bernstein
// coefficients b_i.d: if all are positive, so is N.d over the step.
//
// Error bounds, in the notation of bernstein.h. M_k bounds coordinate k of the two edges, S_k is
// the product of the other two M, and S = S_x + S_y + S_z.
//
//   quantity            | operations               | error in u          | size
//   b_i, coordinate k   | cross, middle            | 10 S_k              | 2 S_k
//   times d_k           | exact, |d_k| <= 2        | 20 S_k              | 4 S_k
//   b_i . d             | three of these, two sums | 20 + 4 + 4 = 28 S   | 4 S
//
// facing_units = 32 covers this, errors of second order, and the rounding of S.

namespace {

constexpr double facing_units = 32;

// The axes through the faces, edges and corners of a cube, and those between an edge's middle and
// a face's middle. From any direction the nearest of them is at most 22 degrees away.
constexpr double axes[3][facing_axes] = {
    {1, 0, 0, 1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2},
    {0, 1, 0, 1, -1, 0, 0, 1, 1, 1, 1, -1, -1, 1, 1, -1, -1, 2, 2, -2, -2, 1, 1, -1, -1},
    {0, 0, 1, 0, 0, 1, -1, 1, -1, 1, -1, 1, -1, 2, -2, 2, -2, 1, -1, 1, -1, 1, -1, 1, -1}};

}  // namespace

Direction direction(int bit) {
  const double sign = bit % 2 ? -1 : 1;
  return {sign * axes[0][bit / 2], sign * axes[1][bit / 2], sign * axes[2][bit / 2]};
}

DirectionSet faced_directions(const std::array<MovingPoint, 3>& triangle) {
  const MovingVector e1 = difference(triangle[1], triangle[0]);
  const MovingVector e2 = difference(triangle[2], triangle[0]);
  Vector m = {0, 0, 0};
  grow(m, e1);
  grow(m, e2);
  if (!in_range(m)) return 0;
  const CrossQuadratic n = cross(e1, e2);
  const double bound = facing_units * unit_roundoff * (m[1] * m[2] + m[2] * m[0] + m[0] * m[1]);
  double least[facing_axes], greatest[facing_axes];
  for (int i = 0; i < facing_axes; ++i) {
    const auto along = [&](const Vector& b) {
      return b[0] * axes[0][i] + b[1] * axes[1][i] + b[2] * axes[2][i];
    };
    const double c0 = along(n.b0), c1 = along(n.b1), c2 = along(n.b2);
    const double lo = c0 < c1 ? c0 : c1, hi = c0 > c1 ? c0 : c1;
    least[i] = lo < c2 ? lo : c2;
    greatest[i] = hi > c2 ? hi : c2;
  }
  DirectionSet set = 0;
  for (int i = 0; i < facing_axes; ++i) {
    set |= DirectionSet{least[i] > bound} << (2 * i);
    set |= DirectionSet{greatest[i] < -bound} << (2 * i + 1);
  }
  return set;
}

int nearest_direction(DirectionSet set, const Vector& vector) {
  int nearest = std::countr_zero(set);
  double greatest = -HUGE_VAL;
  for (; set != 0; set &= set - 1) {
    const int bit = std::countr_zero(set);
    const Direction d = direction(bit);
    const double cosine = dot(d, vector) / std::sqrt(dot(d, d));
    if (cosine > greatest) {
      greatest = cosine;
      nearest = bit;
    }
  }
  return nearest;
}

}  // namespace assay::detector
