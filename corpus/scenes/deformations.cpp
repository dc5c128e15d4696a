#include <array>
#include <cmath>

#include "corpus/scenes/shapes.h"

namespace assay::corpus {

namespace {

using detector::Point;

// Returns the coordinates in which the centre is 0, the half-length 1, and the long axis the last
// one.
Point to_unit(const Point& x, const Extent& e) {
  Point u{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t axis = (e.axis + 1 + k) % 3;
    u[k] = (x[axis] - e.centre[axis]) / e.radius;
  }
  return u;
}

Point from_unit(const Point& u, const Extent& e) {
  Point x{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t axis = (e.axis + 1 + k) % 3;
    x[axis] = e.centre[axis] + e.radius * u[k];
  }
  return x;
}

// Returns 1 at x = 0, and 0 with zero slope from |x| = 1 on.
double bump(double x_squared) {
  const double w = x_squared < 1 ? 1 - x_squared : 0;
  return w * w;
}

}  // namespace

Extent extent_of(const detector::PositionsView& positions) {
  Extent extent;
  extent.radius = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double lo = positions.col(k).minCoeff(), hi = positions.col(k).maxCoeff();
    const auto axis = static_cast<std::size_t>(k);
    extent.centre[axis] = lo / 2 + hi / 2;
    const double half = hi / 2 - lo / 2;
    if (half > extent.radius) {
      extent.radius = half;
      extent.axis = axis;
    }
  }
  if (extent.radius == 0) extent.radius = 1;
  return extent;
}

Point breathe(const Point& x, double s, const Extent& e) {
  if (s == 0) return x;
  Point u = to_unit(x, e);
  // s runs over three quarters of a period, out, back and in, so that two frames already differ.
  const double length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  const double height = length > 0 ? u[2] / length : 0;
  const double factor = 1 + sin_turn(0.75 * s) * (0.25 + 0.05 * cos_turn(height));
  for (double& coordinate : u) coordinate *= factor;
  return from_unit(u, e);
}

Point bend(const Point& x, double s, const Extent& e) {
  if (s == 0) return x;
  const Point u = to_unit(x, e);
  constexpr double turns_at_end = 1.02, length = 2;
  const double turns = turns_at_end * s;
  const double radius = length / (2 * pi * turns);
  const double turn = turns * u[2] / length;
  return from_unit(
      {radius - (radius - u[0]) * cos_turn(turn), u[1], (radius - u[0]) * sin_turn(turn)}, e);
}

Point twist(const Point& x, double s, const Extent& e) {
  if (s == 0) return x;
  const Point u = to_unit(x, e);
  const double c = cos_turn(s * u[2] / 2), d = sin_turn(s * u[2] / 2);
  return from_unit({c * u[0] - d * u[1], d * u[0] + c * u[1], u[2]}, e);
}

Point crumple(const Point& x, double s, const Extent& e) {
  if (s == 0) return x;
  struct Wave {
    Point turns;   // per half-length, along each axis
    double phase;  // turns
    Point direction;
  };
  constexpr std::array<Wave, 5> waves = {{{{0.9, -0.5, 0.3}, 0.11, {0.2, 0.1, -0.25}},
                                          {{-0.4, 1.1, 0.6}, 0.37, {-0.15, 0.2, 0.1}},
                                          {{0.7, 0.6, -1.0}, 0.59, {0.1, -0.2, 0.2}},
                                          {{-1.2, 0.2, 0.8}, 0.83, {0.2, 0.15, 0.1}},
                                          {{0.3, -0.9, -1.1}, 0.23, {-0.1, 0.25, -0.15}}}};
  const Point u = to_unit(x, e);
  Point moved = {u[0] * (1 - 0.3 * s), u[1] * (1 - 0.3 * s), u[2] * (1 - 0.3 * s)};
  for (const Wave& wave : waves) {
    const double place =
        wave.turns[0] * u[0] + wave.turns[1] * u[1] + wave.turns[2] * u[2] + wave.phase;
    for (std::size_t k = 0; k < 3; ++k) moved[k] += s * wave.direction[k] * sin_turn(place);
  }
  return from_unit(moved, e);
}

Point dent(const Point& x, double s, const Extent&) {
  constexpr double width = 0.7, depth = 2.3;
  if (x[2] <= 0) return x;
  const double w = bump((x[0] * x[0] + x[1] * x[1]) / (width * width));
  return {x[0], x[1], x[2] - depth * s * w};
}

Point pinch(const Point& x, double s, const Extent&) {
  // One side moves faster, so that the two do not meet vertex on vertex.
  constexpr double width = 0.5, way_up = 0.75, way_down = 0.6;
  const double w = s * bump(x[0] * x[0] / (width * width));
  return {x[0], x[1] > 0 ? x[1] - way_up * w : x[1] + way_down * w, x[2]};
}

Point fold(const Point& x, double s, const Extent&) {
  constexpr double begin = -0.05, length = 0.4, turns_at_end = 0.6;
  if (s == 0 || x[0] <= begin) return x;
  const double turns = turns_at_end * s;
  const double radius = length / (2 * pi * turns);
  const double bent = x[0] - begin < length ? x[0] - begin : length;
  const double straight = x[0] - begin - bent;
  const double turn = turns * bent / length;
  const double c = cos_turn(turn), d = sin_turn(turn);
  return {begin + radius * d + straight * c, x[1], radius * (1 - c) + straight * d};
}

Point narrow(const Point& x, double s, const Extent&) {
  constexpr double width = 2, deepest = 0.6;
  const double factor = 1 - deepest * s * bump(x[2] * x[2] / (width * width));
  return {x[0] * factor, x[1] * factor, x[2]};
}

namespace {

using detector::Point;

constexpr double tube_radius = 0.5, tube_half_length = 3;

// Returns exactly 0 at both ends of the period, and 1 in its middle.
double there_and_back(double s) { return sin_turn(s / 2); }

}  // namespace

Point turn_inside_out(const Point& x, double s, const Extent&) {
  constexpr double roll = 0.3;  // radius of the rolled rim
  constexpr double rim = pi * roll, length = 2 * tube_half_length;
  // The height of the rim in the rest shape. It moves from the upper end to beyond the lower one.
  const double fold = tube_half_length - (length + rim) * there_and_back(s);
  const double beyond = x[2] - fold;
  if (beyond <= 0) return x;
  double radius = tube_radius + 2 * roll, z = fold - (beyond - rim);
  if (beyond < rim) {
    const double turn = beyond / (2 * pi * roll);
    radius = tube_radius + roll * (1 - cos_turn(turn));
    z = fold + roll * sin_turn(turn);
  }
  const double factor = radius / tube_radius;
  return {factor * x[0], factor * x[1], z};
}

Point bite_tail(const Point& x, double s, const Extent&) {
  constexpr double narrow_end = 0.3;  // of the wide one
  constexpr double slope = 0.8;       // of the cut, in the arc's plane
  constexpr double fewest_turns = 0.85, most_turns = 1.1;
  const double height = x[2] / tube_half_length;
  const double width = 1 - (1 - narrow_end) * (height + 1) / 2;
  const double across = width * x[0];
  const double along = x[2] + (height > 0 ? slope * height * across : 0);
  const double turns = fewest_turns + (most_turns - fewest_turns) * there_and_back(s);
  const double radius = 2 * tube_half_length / (2 * pi * turns);
  const double turn = turns * along / (2 * tube_half_length);
  return {radius - (radius - across) * cos_turn(turn), width * x[1],
          (radius - across) * sin_turn(turn)};
}

Point wind(const Point& x, double s, const Extent&) {
  constexpr double outer = 1, inner = 0.3;
  constexpr double fewest_turns = 1.25, most_turns = 2.75;
  const double turn = x[0] * (fewest_turns + (most_turns - fewest_turns) * there_and_back(s));
  const double radius = outer - (outer - inner) * x[0];
  return {radius * cos_turn(turn), radius * sin_turn(turn), x[1]};
}

double ball_height(double s) {
  constexpr double farthest = 4.5;
  return 2 * farthest * there_and_back(s) - farthest;
}

}  // namespace assay::corpus
