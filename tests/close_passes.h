// Steps in which a triangle passes another one within a unit in the last place before the contact.
// So for each place before the contact, rounding decides whether the straight way there is free.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "tests/meshes.h"

namespace assay::tests {

struct ClosePass {
  std::string name;
  detector::Triangles triangles;
  detector::Positions x_t0, x_t1;
};

// Returns steps that campaigns found. Their contacts are at 1, 0.698, 0.869 and 2/3. The largest
// share of the time until the contact to which the way is free is 0.711, 0.998, 0.894 and 0.75.
inline std::vector<ClosePass> known_close_passes() {
  const auto pass = [](const char* name, const char* triangles, const char* x_t0,
                       const char* x_t1) {
    return ClosePass{name, triangles_of(triangles), positions_of(x_t0), positions_of(x_t1)};
  };
  return {
      pass("along the side of a sliver", "0 4 5, 1 2 3",
           "3 -3 0, 1 -1.0000000000000002 0, 1 -1 0, -1 1 0, 1 0 0, 0 0 1",
           "1 -1 0, 2 -2 0, 1 -1 0, -1 1 0, 1 0 0, 0 0 1"),
      pass("through the line of its own edge", "0 2 1, 2 3 5, 2 4 3",
           "0.5 -1 0.5, 0 8 0, 0.1480398971478109 6 0.14803989714781096, -1 -3 1, 1.2 -5 3.1, "
           "0.6 0 1.8",
           "0.5 -1 0.5, 0 8 0, -0.101960102852189 9 -0.10196010285218904, -1 -3 1, 1.2 -5 3.1, "
           "0.6 0 1.8"),
      pass("nearly coplanar, sharing an edge", "0 2 1, 0 3 2",
           "0 0 0.11328125000000004, 1 0 0.11328125, -2 1 0.11328124999999996, -2 -2 0.11328125",
           "1 0 -0.67578125, -1 -1 -0.67578125, 0 0 -0.67578125, -2 -2 -0.67578125"),
      pass("nearly coplanar, sharing a vertex", "4 3 1, 4 2 0",
           "0 0 0, 1 0 0.7562828504014758, 0 1 0.7562828504014758, 0 -1 0.7562828504014758, "
           "-1 0 0.756282850401476",
           "0 0 0, 1 0 0.7562828504014758, 0 -1 0.7562828504014759, 0 -1 0.7562828504014758, "
           "-1 0 0.756282850401476")};
}

// Returns a step in which a moving triangle passes a resting triangle as closely as doubles allow,
// or touches it by an ulp, and reaches a resting plate at t = 0.9. With an even seed its edge
// passes a corner of the resting triangle, with an odd seed its corner passes an edge.
inline ClosePass drawn_close_pass(std::uint64_t seed) {
  using Row = Eigen::RowVector3d;
  std::mt19937_64 engine(seed);
  const auto number = [&] { return 0x1p-52 * static_cast<double>(engine() >> 11) - 1; };
  const auto point = [&] { return Row(number(), number(), number()); };
  const bool is_edge = seed % 2 == 0;
  const Row a = point(), b = point(), way = 16 * (point() + Row(0, 0, -3));
  const Row passed = is_edge ? b : Row(0.5 * (a + b)), along = is_edge ? point() : Row(0, 0, 0);
  const Row start = passed - (0.7 + 0.1 * number()) * way, end = start + 0.9 * way;
  ClosePass pass{"drawn " + std::to_string(seed), triangles({{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}),
                 detector::Positions(9, 3), detector::Positions(9, 3)};
  pass.x_t0 << a, b, a + Row(2, 0.5, 0),                                                   //
      start - along, start + along + Row(0, 0, is_edge ? 0 : 3), start + Row(-0.5, 0, 3),  //
      end + Row(-99, -99, 0), end + Row(99, -99, 0), end + Row(0, 99, 0);
  pass.x_t0.bottomRows(3).col(2).array() -= std::abs(along.z());
  pass.x_t1 = pass.x_t0;
  pass.x_t1.middleRows(3, 3).rowwise() += way;
  return pass;
}

}  // namespace assay::tests
