// The reducer: from a failing case to the smallest one that fails with the same signature.
//
// It is a list of passes (search.h) run in a fixed order to a fixed point. A pass proposes cases;
// one is kept when it is smaller (MeshSize) and the judge finds the same signature in it. No
// proposal is judged twice, only valid cases are judged (case_edits.h). The same case, judge and
// limit of calls give the same bytes; a limit of time only ends the search earlier.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"

namespace assay::properties {

// What a case shows when it fails.
struct Finding {
  // Claim, outcome, stage and feature type: "all-pairs/missing/view sets/vertex-face".
  std::string signature;
  // Triangles of the reported pair, if any: what is far from them is tried first.
  std::vector<std::int32_t> focus;
  std::size_t step = 0;          // the step that shows it: those behind it are dropped
  std::string explanation = {};  // one line for people, of this case
};

// Runs a case: nothing when it holds. Must be deterministic.
using Judge = std::function<std::optional<Finding>(const corpus::Case&)>;

struct ReduceLimits {
  double seconds = 60;
  std::uint64_t calls = 100000;  // of the judge
};

struct PassStatistics {
  std::string name;
  std::uint64_t tries = 0, accepted = 0;  // calls of the judge; smaller cases found
  double seconds = 0;
};

struct Reduction {
  corpus::Case smallest;
  Finding finding;  // of `smallest`; without a signature if the given case did not fail
  std::uint64_t calls = 0;
  double seconds = 0;
  bool fixed_point = false;  // no pass finds anything smaller; false if a limit ended it
  // Above 0: only its size shows the failure. So many triangles of the case fail, and no fewer that
  // were tried (cut_large_mesh of search.h).
  std::size_t fails_from = 0;
  std::vector<PassStatistics> passes;
};

// "fails from 5001 triangles on": how Reduction::fails_from is said.
std::string fails_from_text(std::size_t triangles);

// Is called with each smaller case as soon as it is found, so that what it saves is never lost.
using OnBetter = std::function<void(const corpus::Case&)>;

// Returns the case with the view primitive that the detector chose by itself written into it;
// nothing if it chose none. The mesh can then shrink without moving the primitive.
using MakeViewExplicit = std::function<std::optional<corpus::Case>(const corpus::Case&)>;

// The result keeps the case's id, texts and options; expected facts are cleared.
Reduction reduce(const corpus::Case& failing, const Judge& judge, const ReduceLimits& limits,
                 const OnBetter& on_better = {}, const MakeViewExplicit& make_view_explicit = {});

// How large a case is, as the reducer sees it: it prefers the case with the smaller size.

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
