// What the suites of `assay bench` want to see: speeds, memory and shares, each under a name that
// ends with its unit. A name without a unit is a ratio. Suites hand these values to their rows, and
// reports/README.md says which row is held against which of them.
//
// A bound that is no choice has no name here. It stands in its row: no wrong answer (at_most(0)),
// every answer the same (at_least(100) %), cheaper than what it takes the place of (below(1)).
#pragma once

#include <optional>

namespace assay::reports {

// What a row is held against.
struct Wanted {
  enum class Sense : unsigned char { at_most, at_least, below } sense = Sense::at_most;
  double bound = 0;
};
constexpr Wanted at_most(double bound) { return {Wanted::Sense::at_most, bound}; }
constexpr Wanted at_least(double bound) { return {Wanted::Sense::at_least, bound}; }
constexpr Wanted below(double bound) { return {Wanted::Sense::below, bound}; }
inline std::optional<Wanted> wanted_if(bool condition, Wanted wanted) {
  return condition ? std::optional(wanted) : std::nullopt;
}

namespace wanted {

// Elementary test in exact arithmetic, mean of many queries. The candidates are the feature pairs
// of the rod-twist step whose moving boxes meet: few of them are hits. Nearly all simulation
// queries are hits, and many hand-made ones are degenerate.
inline constexpr Wanted yes_no_of_a_candidate_us = at_most(0.3);
inline constexpr Wanted yes_no_of_a_simulation_query_us = at_most(1);
inline constexpr Wanted yes_no_of_a_hand_made_query_us = at_most(10);
inline constexpr Wanted hit_with_its_time_us = at_most(8);
// The time that one query in a thousand exceeds, of random queries with exponents within 2^+-100
// and over all doubles.
inline constexpr Wanted slow_query_of_usual_numbers_ms = below(1);
inline constexpr Wanted slow_query_of_any_numbers_ms = below(10);
// The slowest of the kept family of queries with exponents over all doubles, views too.
inline constexpr Wanted slowest_query_of_any_numbers_ms = below(100);

// View test of a mesh over the writing of its swept boxes, in the instruction set that is chosen.
inline constexpr Wanted view_test_of_a_point_over_boxes = at_most(2.5);
inline constexpr Wanted view_test_of_a_line_over_boxes = at_most(3);

// Step in which all triangles are positive, so that no tree is touched. The time is that of a mesh
// of so many triangles, seen from a point.
inline constexpr int free_step_triangles = 327'680;
inline constexpr Wanted free_step_ms = at_most(10);
inline constexpr Wanted free_step_over_bvh = at_most(1. / 50);

// View sets, in percent of the triangles: V+ and V- on bent and twisted tubes from a line; V+ of
// the bunny, at rest and bent; V0 of bounded arithmetic that the exact V0 does not have.
inline constexpr Wanted tube_settled_from_a_line_percent = at_least(95);
inline constexpr Wanted bunny_positive_from_a_point_percent = at_least(89);
inline constexpr Wanted bunny_positive_from_a_line_percent = at_least(94);
inline constexpr Wanted zero_beyond_exact_in_bounded_percent = at_most(0.1);

// Whole step of rod-twist (79,864 triangles, all pairs, exact) with a culling that uses views.
inline constexpr Wanted rod_twist_step_s = at_most(1.2);
inline constexpr Wanted rod_twist_candidates_over_bvh = at_most(0.7);
inline constexpr Wanted rod_twist_step_over_bvh = at_most(0.85);

// Whole step of any mesh. view-auto falls back to bvh where views do not pay, so all that it may
// lose is what it takes to find that out.
inline constexpr Wanted view_auto_over_bvh = at_most(1.05);
inline constexpr Wanted exact_over_double = at_most(1.3);

// Whole sequences with culling auto, over the single culling that takes the least for the whole of
// each: the sum, the median step, and any step of a millisecond or more. A first step over bvh's,
// whose pairs it has to look at. One thread over two.
inline constexpr Wanted auto_over_best_culling = at_most(1.05);
inline constexpr Wanted auto_step_over_best_culling = at_most(1.15);
inline constexpr Wanted first_step_over_bvh = at_most(1.1);
inline constexpr Wanted two_threads_gain = at_least(1.8);

// Marking of the vBVHs in percent of a step that searches: how the thesis's "low" is read here.
inline constexpr Wanted marking_percent = at_most(5);

// Oracle: the rod-twist step on two threads, with the memory beyond that of the mesh itself, and
// the mean of a simulation query, yes or no.
inline constexpr Wanted oracle_rod_twist_s = at_most(30);
inline constexpr Wanted oracle_rod_twist_gb = at_most(3);
inline constexpr Wanted oracle_simulation_query_us = at_most(20);

// Campaign: steps that oracle and detector, in all its configurations, judge in a second on a core.
inline constexpr Wanted judged_generic_steps_a_second = at_least(100);
inline constexpr Wanted judged_degenerate_steps_a_second = at_least(10);

// Growth from a thousand to a million triangles: the highest memory of preprocessing and a step.
// The exponent of times is held against that of n log n over the same sizes, so it has no name.
inline constexpr Wanted memory_bytes_a_triangle = at_most(400);

}  // namespace wanted
}  // namespace assay::reports
