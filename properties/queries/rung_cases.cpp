#include "properties/queries/rung_cases.h"

#include <vector>

#include "properties/words.h"

namespace assay::properties {
namespace {

using detector::MovingPoint;
using detector::Point;
using oracle::Rung;

MovingPoint rest(const Point& p) { return {p, p}; }

Query over_resting_face(const Point& from, const Point& to) {
  return {{MovingPoint{from, to}, rest({0, 0, 0}), rest({4, 0, 0}), rest({0, 4, 0})}, 1};
}

Query edges(const MovingPoint& a0, const MovingPoint& a1, const MovingPoint& b0,
            const MovingPoint& b1) {
  return {{a0, a1, b0, b1}, 2};
}

std::vector<RungCase> make() {
  const double below_third = 0x1.5555555555555p-2, above_third = 0x1.5555555555556p-2;
  const double below_cube_root = 0x1.965fea53d6e3cp-1,
               above_cube_root = 0x1.965fea53d6e3dp-1;  // of 1/2
  const double below_square_root = 0x1.6a09e667f3bccp-1, above_square_root = 0x1.6a09e667f3bcdp-1;
  return {
      {"ordered at both ends", over_resting_face({1, 1, 1}, {1, 1, 0.5}), false, Rung::axis, {}},
      {"edges beside each other",
       edges(rest({0, 0, 0}), rest({1, 0, 0}), rest({2, 0, 0}), rest({3, 0, 0})),
       false,
       Rung::axis,
       {}},
      {"passes beside the face",
       over_resting_face({3, 3, 1}, {3, 3.5, -1}),
       false,
       Rung::interval,
       {}},
      {"crosses the face",
       over_resting_face({1, 1, 1}, {1, 1, -2}),
       true,
       Rung::interval,
       {below_third, above_third}},
      {"edges cross",
       edges(rest({-1, 0, 0}), rest({1, 0.25, 0}), MovingPoint{{0.125, -1, 1}, {0.125, -1, -2}},
             MovingPoint{{0, 1, 1}, {0, 1, -2}}),
       true,
       Rung::interval,
       {below_third, above_third}},
      {"crosses far from the origin",
       {{MovingPoint{{0x1p40 + 1, 0x1p40 + 1, 0x1p40 + 1}, {0x1p40 + 1, 0x1p40 + 1, 0x1p40 - 1}},
         rest({0x1p40, 0x1p40, 0x1p40}), rest({0x1p40 + 4, 0x1p40, 0x1p40}),
         rest({0x1p40, 0x1p40 + 4, 0x1p40})},
        1},
       true,
       Rung::interval,
       {0.5, 0.5}},
      {"touches at the end",
       over_resting_face({1, 1, 1}, {1, 1, 0}),
       true,
       Rung::quadratic,
       {1, 1}},
      {"starts in contact", over_resting_face({1, 1, 0}, {1, 1, 5}), true, Rung::quadratic, {0, 0}},
      {"meets an edge of the face",
       over_resting_face({2, 0, 1}, {2, 0, -1}),
       true,
       Rung::quadratic,
       {0.5, 0.5}},
      {"meets a corner of the face",
       over_resting_face({4, 0, 3}, {4, 0, -1}),
       true,
       Rung::quadratic,
       {0.75, 0.75}},
      {"coplanar throughout",
       over_resting_face({4, 4, 0}, {0, 0, 0}),
       true,
       Rung::quadratic,
       {0.5, 0.5}},
      {"collinear throughout",
       edges(MovingPoint{{0, 0, 0}, {3, 3, 3}}, MovingPoint{{1, 1, 1}, {4, 4, 4}}, rest({2, 2, 2}),
             rest({9, 9, 9})),
       true,
       Rung::quadratic,
       {below_third, above_third}},
      {"all points coincide",
       edges(rest({1, 2, 3}), rest({1, 2, 3}), rest({1, 2, 3}), rest({1, 2, 3})),
       true,
       Rung::quadratic,
       {0, 0}},
      {"crosses at 2^400, beyond the intervals",
       {{MovingPoint{{0x1p400, 0x1p400, 0x1p400}, {0x1p400, 0x1p400, -0x1p401}}, rest({0, 0, 0}),
         rest({0x1p402, 0, 0}), rest({0, 0x1p402, 0})},
        1},
       true,
       Rung::quadratic,
       {below_third, above_third}},
      // F is a multiple of (1 + t)(2 t^2 - 1), and so is L of the corner that moves along y.
      {"meets an edge at the square root of 1/2",
       {{MovingPoint{{0, 0, 1}, {2, 0, 1}}, rest({0, 0, 0}), MovingPoint{{3, 0, 0}, {3, 0, 3}},
         MovingPoint{{0, 4, 0}, {0, 8, 0}}},
        1},
       true,
       Rung::quadratic,
       {below_square_root, above_square_root}},
      // 2^-1200 F = t^3 - 1/2, and the weights of the corners are as 1 : t : t^2.
      {"a cube root at 2^400, beyond the intervals",
       {{rest({0, 0, 0}), MovingPoint{{0, 0, -0x1p399}, {0x1p400, 0, -0x1p399}},
         MovingPoint{{-0x1p400, 0, 0}, {-0x1p400, 0x1p400, 0}},
         MovingPoint{{0, -0x1p400, 0}, {0, -0x1p400, 0x1p400}}},
        1},
       true,
       Rung::quadratic,
       {below_cube_root, above_cube_root}},
  };
}

}  // namespace

std::span<const RungCase> rung_cases() {
  static const std::vector<RungCase> cases = make();
  return cases;
}

const char* name_of(Rung rung) { return word_of({"axis", "interval", "quadratic"}, rung); }

}  // namespace assay::properties
