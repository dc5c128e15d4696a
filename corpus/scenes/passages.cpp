#include "corpus/scenes/passages.h"

#include "corpus/scenes/trigonometry.h"

namespace assay::corpus {
namespace {

using detector::Point;

constexpr double tube_radius = 0.5, tube_half_length = 3;

// Exactly 0 at both ends of the period, and 1 in its middle.
double there_and_back(double s) { return sin_turn(s / 2); }

}  // namespace

Point turn_inside_out(const Point& x, double s, const Extent&) {
  constexpr double roll = 0.3;  // radius of the rolled rim
  constexpr double rim = pi * roll, length = 2 * tube_half_length;
  // The rim is at this height of the rest shape, which goes from the upper end to beyond the lower
  // one.
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
