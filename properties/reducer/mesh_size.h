// How large a case is, as the reducer sees it: it prefers the case with the smaller size.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"

namespace assay::properties {

// The fields are compared one by one in this order: first how much there is, then how simple it is.
// Every field is a whole number that is never negative, so a search that only goes to smaller sizes
// ends.
struct MeshSize {
  std::size_t steps = 0, triangles = 0, vertices = 0;
  std::size_t frames = 0;  // positions of all vertices that the steps go between
  std::size_t moving = 0;  // vertices that move, summed over the steps
  // 0: no view is given; 1: a fixed point; 2: a moving point; 3: a fixed line; 4: a moving line.
  int view = 0;
  std::size_t ghosts = 0;  // ghost triangles that the case itself brings
  // How much the relation leaves out by name: bodies, rings, a distance at rest, pairs in lists.
  std::size_t relation = 0;
  std::uint64_t numbers = 0;  // sum of number_cost over all coordinates, view and apexes included
  friend auto operator<=>(const MeshSize&, const MeshSize&) = default;
};

// How hard a number is to read. A whole number from -9 to 9 costs its magnitude; a longer one costs
// 10 for each digit. Any other number costs 100, and 10 more for each character of the shortest
// decimal that reads back to the same double. Examples: 7 costs 7, 250 costs 30, 0.5 costs 130.
std::uint64_t number_cost(double value);

// O(size of the case).
MeshSize size_of(const corpus::Case& c);

// "162 triangles, 83 vertices, 8 steps"; of a query (query_case.h) "one vertex-face query".
std::string size_text(const corpus::Case& c);

// "162 triangles, 83 vertices, 8 steps -> 4 triangles, 4 vertices, 1 step"; one of them if they are
// alike, as those of queries are.
std::string size_text(const corpus::Case& before, const corpus::Case& after);

// The coordinates of a case as a list, and simpler values for one of them.

// Coordinates that are changed together: those on one axis of one place (a vertex, an end of the
// view primitive, an apex), in all frames in which they have the same value. So what rests goes on
// resting.
using NumberGroup = std::vector<double*>;

// All groups: those of vertex 0, 1, .. by axis and value, then those of the view, then those of
// the apexes. Valid as long as the shape of `c` is not changed.
std::vector<NumberGroup> number_groups(corpus::Case& c);

// Values of lower number_cost, the simplest first: small integers, then `value` with fewer digits.
std::vector<double> simpler_values(double value);

// The value rounded to `digits` significant decimal digits.
double rounded_to_digits(double value, int digits);

}  // namespace assay::properties
