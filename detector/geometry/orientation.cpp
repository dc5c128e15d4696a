#include "detector/geometry/orientation.h"

#include "detector/exact/polynomial.h"

namespace assay::detector {
namespace {

int exact_orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const std::array<double, 12> values = {a[0], a[1], a[2], b[0], b[1], b[2],
                                         c[0], c[1], c[2], d[0], d[1], d[2]};
  std::array<Integer, 12> x;
  to_common_integers(values, x);
  std::array<std::array<Integer, 3>, 3> u;
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t k = 0; k < 3; ++k) u[j][k] = x[3 * (j + 1) + k] - x[k];
  }
  const Integer det = u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) +
                      u[0][1] * (u[1][2] * u[2][0] - u[1][0] * u[2][2]) +
                      u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
  return det.sign();
}

// Four differences of points, with the bound of orientation.h for each orientation of three of
// them: M_k is the largest |coordinate k| of all four.
struct Differences {
  Differences(const Point& origin, const std::array<const Point*, 4>& points) {
    double magnitude[3] = {0, 0, 0};
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 3; ++k) {
        u[j][k] = (*points[j])[k] - origin[k];
        magnitude[k] = std::max(magnitude[k], std::abs(u[j][k]));
      }
    }
    in_range = true;
    for (const double m : magnitude) in_range &= m > least_magnitude && m < greatest_magnitude;
    bound = orientation_error<ProvedBounds> * (magnitude[0] * magnitude[1] * magnitude[2]);
  }
  // Returns u[i] . (u[j] x u[k]).
  double volume(std::size_t i, std::size_t j, std::size_t k) const {
    const double n[3] = {u[j][1] * u[k][2] - u[j][2] * u[k][1],
                         u[j][2] * u[k][0] - u[j][0] * u[k][2],
                         u[j][0] * u[k][1] - u[j][1] * u[k][0]};
    return u[i][0] * n[0] + u[i][1] * n[1] + u[i][2] * n[2];
  }

  double u[4][3], bound;
  bool in_range;
};

// Returns whether doubles prove that both ends of the segment are strictly on one side of the
// triangle's plane.
bool surely_on_one_side(const Point& e0, const Point& e1, const std::array<Point, 3>& face) {
  const Differences from(face[0], {&face[1], &face[2], &e0, &e1});
  const double side0 = from.volume(2, 0, 1), side1 = from.volume(3, 0, 1);
  return from.in_range && ((side0 > from.bound && side1 > from.bound) ||
                           (side0 < -from.bound && side1 < -from.bound));
}

// Returns whether doubles prove that the segment's line passes outside of the triangle: two of its
// edges turn around the line in opposite senses.
bool surely_turns_both_ways(const Point& e0, const Point& e1, const std::array<Point, 3>& face) {
  const Differences from(e0, {&e1, &face[0], &face[1], &face[2]});
  const double turns[3] = {from.volume(0, 1, 2), from.volume(0, 2, 3), from.volume(0, 3, 1)};
  const double least = std::min({turns[0], turns[1], turns[2]}),
               greatest = std::max({turns[0], turns[1], turns[2]});
  return from.in_range && least < -from.bound && greatest > from.bound;
}

}  // namespace

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int sign = filtered_orientation<ProvedBounds>(a, b, c, d);
  return sign != 0 ? sign : exact_orientation(a, b, c, d);
}

bool segment_pierces_triangle(const Point& e0, const Point& e1, const std::array<Point, 3>& face) {
  if (surely_on_one_side(e0, e1, face) || surely_turns_both_ways(e0, e1, face)) return false;
  const int side0 = orientation(face[0], face[1], face[2], e0);
  if (side0 == 0) return false;
  if (orientation(face[0], face[1], face[2], e1) != -side0) return false;
  const int turn = orientation(e0, e1, face[0], face[1]);
  return turn != 0 && orientation(e0, e1, face[1], face[2]) == turn &&
         orientation(e0, e1, face[2], face[0]) == turn;
}

// The segment pierces the triangle strictly if its ends lie strictly on opposite sides of the
// triangle's plane and its line passes strictly inside the three edges (segment_pierces_triangle).
// If the sides of the plane cannot be told, as between coplanar triangles, projections may settle
// it: a segment that pierces meets the triangle in the projection along every axis. In a
// projection the two are apart if a line through an edge of the triangle, or through the segment,
// has one of them strictly on one side and no point of the other on that side.

namespace {

bool surely_apart(const Point& e0, const Point& e1, const std::array<Point, 3>& face,
                  std::size_t axis) {
  const auto &a = face[0], &b = face[1], &c = face[2];
  const int of_segment = sure_side(e0, e1, a, axis);
  if (of_segment != 0 && sure_side(e0, e1, b, axis) == of_segment &&
      sure_side(e0, e1, c, axis) == of_segment) {
    return true;
  }
  const int inside = sure_side(a, b, c, axis);
  if (inside == 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &u = face[i], &v = face[(i + 1) % 3];
    if (sure_side(u, v, e0, axis) == -inside && sure_side(u, v, e1, axis) == -inside) return true;
  }
  return false;
}

// On which sides of the triangle's plane the two ends are, and the signs of the three turns of the
// triangle's edges around the segment.
template <class Bounds>
struct PiercingSigns {
  PiercingSigns(const Point& e0, const Point& e1, const std::array<Point, 3>& face)
      : side0(filtered_orientation<Bounds>(face[0], face[1], face[2], e0)),
        side1(filtered_orientation<Bounds>(face[0], face[1], face[2], e1)),
        turns{filtered_orientation<Bounds>(e0, e1, face[0], face[1]),
              filtered_orientation<Bounds>(e0, e1, face[1], face[2]),
              filtered_orientation<Bounds>(e0, e1, face[2], face[0])} {}

  bool pierces() const {
    return side0 * side1 < 0 && turns[0] != 0 && turns[0] == turns[1] && turns[1] == turns[2];
  }

  int side0, side1;
  std::array<int, 3> turns;
};

}  // namespace

Decision bounded_piercing(const Point& e0, const Point& e1, const std::array<Point, 3>& face) {
  const PiercingSigns<ProvedBounds> signs(e0, e1, face);
  if (signs.pierces()) return Decision::yes;
  if (signs.side0 * signs.side1 > 0) return Decision::no;
  const auto [least, greatest] = std::minmax_element(signs.turns.begin(), signs.turns.end());
  if (*least < 0 && *greatest > 0) return Decision::no;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (surely_apart(e0, e1, face, axis)) return Decision::no;
  }
  return Decision::open;
}

template <class Number>
bool plain_piercing(const Point& e0, const Point& e1, const std::array<Point, 3>& face) {
  return PiercingSigns<NoBounds<Number>>(e0, e1, face).pierces();
}

template bool plain_piercing<double>(const Point&, const Point&, const std::array<Point, 3>&);
template bool plain_piercing<float>(const Point&, const Point&, const std::array<Point, 3>&);

}  // namespace assay::detector
