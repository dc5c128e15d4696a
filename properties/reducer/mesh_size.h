// How large a case is. The reducer prefers smaller cases in this order.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>

#include "corpus/cases/case_file.h"

namespace assay::properties {

// Shorter counts first, then simpler: the fields are compared one by one in this order. Every
// field is a count that is bounded from below, so a search that only goes to smaller sizes ends.
struct MeshSize {
  std::size_t steps = 0, triangles = 0, vertices = 0;
  std::size_t frames = 0;
  std::size_t moving = 0;  // vertices that move, summed over the steps
  // 0: no view is given; 1: a fixed point; 2: a moving point; 3: a fixed line; 4: a moving line.
  int view = 0;
  std::size_t ghosts = 0;     // ghost triangles given
  std::uint64_t numbers = 0;  // sum of number_cost over all coordinates, view and apexes included
  friend auto operator<=>(const MeshSize&, const MeshSize&) = default;
};

// The cost of a number: 0 for 0, the magnitude for -9 to 9, 10 for each digit of a longer integer;
// for other numbers 100, and 10 for each character of the shortest decimal that reads back to the
// same double.
std::uint64_t number_cost(double value);

// O(size of the case).
MeshSize size_of(const corpus::Case& c);

// "162 triangles, 83 vertices, 8 steps".
std::string size_text(const MeshSize& size);

// "162 triangles, 83 vertices, 8 steps -> 4 triangles, 4 vertices, 1 step".
std::string size_text(const MeshSize& before, const MeshSize& after);

}  // namespace assay::properties
