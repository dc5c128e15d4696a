// Reduces a failing case to the smallest case that fails with the same signature.
//
// A list of passes (search.h) runs in a fixed order, again and again, until no pass finds a smaller
// case. A pass proposes cases; a case is kept if it is smaller (MeshSize) and the judge finds the
// same signature in it. No proposal is judged twice, only valid cases are judged (case_edits.h).
// The same case, judge and limit of calls give the same bytes; a limit of time can only end the
// search earlier.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/words.h"

namespace assay::properties {

// The finding of a judge in a failing case.
struct Finding {
  // Claim, outcome, stage and feature type: "all-pairs/missing/view sets/vertex-face".
  std::string signature;
  // Triangles of the reported pair, if any: triangles far from them are dropped first.
  std::vector<std::int32_t> focus;
  std::size_t step = 0;          // the step that fails: later steps are dropped
  std::string explanation = {};  // one line about this case, for people
};

// Runs a case, and returns what fails; nothing if the case holds. Must be deterministic.
using Judge = std::function<std::optional<Finding>(const Case&)>;

struct ReduceLimits {
  double seconds = 60;
  std::uint64_t calls = 100000;  // the most calls of the judge
};

struct PassStatistics {
  std::string name;
  std::uint64_t tries = 0, accepted = 0;  // calls of the judge, and smaller cases found
  double seconds = 0;
};

struct Reduction {
  Case smallest;
  Finding finding;  // the finding in `smallest`; without a signature if the given case did not fail
  std::uint64_t calls = 0;
  double seconds = 0;
  bool fixed_point = false;  // no pass finds a smaller case; false if a limit ended the search
  // Above 0: the failure depends on size. The case fails with this many triangles and with no
  // smaller number that was tried (cut_large_mesh of search.h).
  std::size_t fails_from = 0;
  std::vector<PassStatistics> passes;
};

// Returns "fails from 5001 triangles on", the text of Reduction::fails_from.
std::string fails_from_text(std::size_t triangles);

// Is called with each smaller case as soon as it is found, so that the case can be saved at once.
using OnBetter = std::function<void(const Case&)>;

// Writes the view primitive that the detector chose by itself into the case, and returns the case;
// nothing if the detector chose none. The mesh can then shrink without moving the primitive.
using MakeViewExplicit = std::function<std::optional<Case>(const Case&)>;

// Reduces a failing case, and keeps its id, texts and options; expected facts are cleared.
Reduction reduce(const Case& failing, const Judge& judge, const ReduceLimits& limits,
                 const OnBetter& on_better = {}, const MakeViewExplicit& make_view_explicit = {});

// Measures the size of a case for the reducer, which prefers smaller sizes.

// The fields are compared one by one in this order: first the amounts, then the simplicity. Every
// field is a whole number that is never negative, so a search that only goes to smaller sizes ends.
struct MeshSize {
  std::size_t steps = 0, triangles = 0, vertices = 0;
  std::size_t frames = 0;  // frames between which the steps go
  std::size_t moving = 0;  // vertices that move, summed over the steps
  // 0: no view is given; 1: a fixed point; 2: a moving point; 3: a fixed line; 4: a moving line.
  int view = 0;
  std::size_t ghosts = 0;  // ghost triangles that the case states
  // How many things the relation states: bodies, rings, a distance at rest, pairs in lists.
  std::size_t relation = 0;
  std::uint64_t numbers = 0;  // sum of number_cost over all coordinates, view and apexes included
  friend auto operator<=>(const MeshSize&, const MeshSize&) = default;
};

// Returns how hard a number is to read. A whole number from -9 to 9 costs its magnitude; a longer
// whole number, up to 15 digits, costs 10 for each digit. Any other number costs 100, and 10 more
// for each character of the shortest decimal that reads back to the same double. Examples: 7 costs
// 7, 250 costs 30, 0.5 costs 130.
std::uint64_t number_cost(double value);

// Measures a case. O(size of the case).
MeshSize size_of(const Case& c);

// Returns "162 triangles, 83 vertices, 8 steps"; for a query "one vertex-face query".
std::string size_text(const Case& c);

// Returns "162 triangles, 83 vertices, 8 steps -> 4 triangles, 4 vertices, 1 step"; only one of the
// two texts if they are equal, as for queries.
std::string size_text(const Case& before, const Case& after);

// Lists the coordinates of a case, and simpler values for one of them.

// Coordinates that are changed together: the coordinates of one point (a vertex, an end of the view
// primitive, an apex) along one axis, in all frames in which they have the same value. So a point
// at rest stays at rest.
using NumberGroup = std::vector<double*>;

// Returns all groups: first the groups of vertex 0, 1, .. by axis and value, then the groups of the
// view primitive, then those of the apexes. The groups are valid as long as the shape of `c` is not
// changed.
std::vector<NumberGroup> number_groups(Case& c);

// Returns values of lower number_cost, simplest first: small integers, then `value` with fewer
// digits.
std::vector<double> simpler_values(double value);

// Returns the value rounded to `digits` significant decimal digits.
double rounded_to_digits(double value, int digits);

}  // namespace assay::properties
