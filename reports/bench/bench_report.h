// The result of a suite of benches: rows, wrong answers, and what else a suite tells, in forms that
// do not depend on the suite. It is written as text, as JSON (schema assay-bench/1,
// reports/bench/README.md) and as CSV, each in one way.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "properties/judging/step_errors.h"
#include "reports/estimate.h"

namespace assay::reports {

// What the suites of `assay bench` want to see: speeds, memory and shares, each under a name that
// ends with its unit. A name without a unit is a ratio. Suites hand these values to their rows;
// reports/bench/README.md says which row is held against which of them.
//
// Only a bound that somebody chose has a name here. The others stand in their rows: no wrong
// answer (at_most(0)), every answer the same (at_least(100) %), cheaper than what it replaces
// (below(1)).

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

// The elementary test in exact arithmetic, as the mean of many queries. Candidates are the feature
// pairs of the rod-twist step whose moving boxes meet; few of them are hits. Of the simulation
// queries nearly all are hits, and of the hand-made ones many are degenerate.
inline constexpr Wanted yes_no_of_a_candidate_us = at_most(0.3);
inline constexpr Wanted yes_no_of_a_candidate_in_lanes_us = at_most(0.1);
inline constexpr Wanted yes_no_of_a_simulation_query_us = at_most(1);
inline constexpr Wanted yes_no_of_a_hand_made_query_us = at_most(10);
inline constexpr Wanted hit_with_its_time_us = at_most(3);
// The time that one query in a thousand exceeds, for random queries with exponents within 2^+-100
// and for such queries with exponents over all doubles.
inline constexpr Wanted slow_query_of_usual_numbers_ms = below(1);
inline constexpr Wanted slow_query_of_any_numbers_ms = below(10);
// The slowest query or view of the kept family with exponents over all doubles.
inline constexpr Wanted slowest_query_of_any_numbers_ms = below(100);

// The view test of a mesh, over the time of writing its swept boxes, in the instruction set that
// the detector chooses.
inline constexpr Wanted view_test_of_a_point_over_boxes = at_most(2.5);
inline constexpr Wanted view_test_of_a_line_over_boxes = at_most(3);

// A step in which all triangles are positive, so that no tree is touched. The time is that of a
// mesh of so many triangles, seen from a point.
inline constexpr int free_step_triangles = 327'680;
inline constexpr Wanted free_step_ms = at_most(10);
inline constexpr Wanted free_step_over_bvh = at_most(1. / 50);
// Over a pass that only reads the same positions and triangles.
inline constexpr Wanted free_step_over_plain_pass = at_most(4);

// View sets, in percent of the triangles: V+ and V- on bent and twisted tubes seen from a line; V+
// of the bunny, at rest and bent; the triangles that are V0 in bounded arithmetic and not in
// exact.
inline constexpr Wanted tube_settled_from_a_line_percent = at_least(95);
inline constexpr Wanted bunny_positive_from_a_point_percent = at_least(89);
inline constexpr Wanted bunny_positive_from_a_line_percent = at_least(94);
inline constexpr Wanted zero_beyond_exact_in_bounded_percent = at_most(0.1);

// The whole step of rod-twist (79,864 triangles, all pairs, exact) with a culling that uses views.
inline constexpr Wanted rod_twist_step_s = at_most(1.2);
// The same by bvh, and its broad phase alone.
inline constexpr Wanted rod_twist_bvh_step_s = at_most(0.4);
inline constexpr Wanted rod_twist_bvh_broad_phase_s = at_most(0.25);
inline constexpr Wanted rod_twist_candidates_over_bvh = at_most(0.7);
inline constexpr Wanted rod_twist_step_over_bvh = at_most(0.85);

// The whole step of any mesh. view-auto falls back to bvh if views do not pay, so it may lose only
// what it takes to find that out.
inline constexpr Wanted view_auto_over_bvh = at_most(1.05);
inline constexpr Wanted exact_over_double = at_most(1.3);

// Whole sequences with culling auto, over the one culling that takes the least for the whole of
// each sequence: the ratio of the sums, of the median steps, and of any step of a millisecond or
// more. Then a first step over that of bvh, whose pairs it has to look at; and one thread over
// two.
inline constexpr Wanted auto_over_best_culling = at_most(1.05);
inline constexpr Wanted auto_step_over_best_culling = at_most(1.15);
inline constexpr Wanted first_step_over_bvh = at_most(1.1);
inline constexpr Wanted two_threads_gain = at_least(1.8);

// Several threads: what a free step gains from a second one, over what a plain pass over the same
// arrays gains from it; and the memory that each further thread takes, in percent of what one
// takes.
inline constexpr Wanted free_step_gain_over_plain_pass = at_least(0.9);
inline constexpr Wanted memory_a_thread_percent = at_most(10);

// Marking of the vBVHs, in percent of a step that searches. The thesis says "low"; this is how
// that is read here.
inline constexpr Wanted marking_percent = at_most(5);

// The oracle: the rod-twist step on two threads, its memory beyond that of the mesh itself, the
// mean of a simulation query, yes or no, and a step of scene bend over its feature candidates:
// where the mirrored ends of the tube meet, queries are degenerate.
inline constexpr Wanted oracle_rod_twist_s = at_most(30);
inline constexpr Wanted oracle_rod_twist_gb = at_most(3);
inline constexpr Wanted oracle_simulation_query_us = at_most(20);
inline constexpr Wanted oracle_planar_candidate_us = at_most(10);

// A campaign: the steps that oracle and detector, in all its configurations, judge in a second on
// a core.
inline constexpr Wanted judged_generic_steps_a_second = at_least(100);
inline constexpr Wanted judged_degenerate_steps_a_second = at_least(10);

// Growth from a thousand to four million triangles: the highest memory of preprocessing and a
// step.
// The exponent of times has no name, because it is held against that of n log n over the same
// sizes.
inline constexpr Wanted memory_bytes_a_triangle = at_most(300);

}  // namespace wanted

enum class RowOutcome : unsigned char { holds, fails, not_judged, no_data };

struct BenchRow {
  std::string label;
  std::string unit;                  // "ns", "times", "%", ...; may be empty
  std::optional<Estimate> measured;  // none: no data
  std::optional<Wanted> wanted;      // none: for information
  std::string note;                  // may be empty

  // Decided by the median alone. The interval shows how far that can be trusted.
  RowOutcome outcome() const;
};

struct BenchReport {
  BenchReport() = default;
  explicit BenchReport(std::string name) : suite(std::move(name)) {}

  std::string suite;
  std::vector<BenchRow> rows;
  // One line for each wrong answer. Any of them fails the run, because times are noisy but answers
  // are not.
  std::vector<std::string> wrong_answers;
  std::string above, below;  // tables of the suite, above and below the rows
  // The fields that the suite adds to the JSON, by name: lists of objects, but for `detector`.
  std::map<std::string, nlohmann::ordered_json, std::less<>> figures;
  // The suite's own CSV: the names of its columns, and its lines with the number of columns that
  // each has; the others of a line are empty. No lines: the CSV is of the samples of the rows.
  std::vector<std::string> columns;
  std::vector<std::pair<std::size_t, std::string>> samples;
  std::string picture;  // a script for gnuplot; empty: the suite has none

  void add(std::string label, std::string unit, Estimate measured,
           std::optional<Wanted> wanted = std::nullopt, std::string note = {});
  // Adds a row that says that the folder or file `missing` is not there.
  void add_no_data(std::string label, const std::string& missing);
  // Adds an object to a field of the JSON.
  void add_figure(std::string_view field, nlohmann::ordered_json object);
  // Adds a line to `samples`. A field that is an object itself has a column for each of its own
  // fields ("late_steps"). Numbers of a list are separated by blanks; other lists are left out.
  void add_sample(const nlohmann::ordered_json& object);
  // Adds a row without a measurement. `why` is its note, such as "left out: ...".
  void add_left_out(std::string label, std::string why);
};

const char* name_of(RowOutcome outcome);
std::string text_of(const Wanted& wanted);

// One line of a table of words. Each word but the last fills its column, whose words end at the
// right, or begin at the left if the width is below 0. `gap` blanks are between columns. REQUIRES
// as many widths as words.
std::string table_line(std::span<const int> widths, const std::vector<std::string>& words,
                       int gap = 1);

// "2: 0.01": in how many steps first times are off, and by which share of a step at worst.
std::string text_of(const properties::TimesOff& off);

// What stands above the rows; the rows as a table, one line each; what stands below them; the
// wrong answers.
std::string text_of(const BenchReport& report);
// `version` is that of the program.
nlohmann::ordered_json to_json(const BenchReport& report, const std::string& version);
// One line for each sample.
std::string csv_of(const BenchReport& report);

// {median, interval, samples}
void to_json(nlohmann::ordered_json& json, const Estimate& estimate);

template <class T>
nlohmann::ordered_json json_value(const T& value) {
  return value;
}
template <class T>
nlohmann::ordered_json json_value(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

// An object with these fields: a name and its value in turn. What is not there is null.
template <class T, class... Rest>
nlohmann::ordered_json json_object(const char* name, const T& value, const Rest&... rest) {
  nlohmann::ordered_json json = {{name, json_value(value)}};
  if constexpr (sizeof...(rest) > 0) json.update(json_object(rest...));
  return json;
}

}  // namespace assay::reports
