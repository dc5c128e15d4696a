// The result of a suite of benches: rows, wrong answers, and what else a suite tells, in forms that
// do not depend on the suite. It is written as text, as JSON (schema assay-bench/2,
// reports/schemas/bench.schema.json) and as CSV, each in one way.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/judging/step_measures.h"
#include "reports/bench/sweep.h"

namespace assay::reports {

// What the suites of `assay bench` want to see: ratios. Suites hand these values to their rows; the
// comments below say to which.
//
// Only a bound that somebody chose has a name here. The others stand in their rows: no wrong
// answer (at_most(0)), every answer the same (at_least(100) %).

// What a row is held against.
struct Wanted {
  bool is_most;  // else it is the least
  double bound;
};
constexpr Wanted at_most(double bound) { return {true, bound}; }
constexpr Wanted at_least(double bound) { return {false, bound}; }
inline std::optional<Wanted> wanted_if(bool condition, Wanted wanted) {
  return condition ? std::optional(wanted) : std::nullopt;
}

namespace wanted {

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

}  // namespace wanted

struct BenchRow {
  std::string label;
  std::string unit;                  // "ns", "times", "%", ...; may be empty
  std::optional<Estimate> measured;  // none: no data
  std::optional<Wanted> wanted;      // none: for information
  std::string note;                  // may be empty

  // "holds", "fails", "no data", or "-" if nothing is wanted. Decided by the median alone; the
  // interval shows how far that can be trusted.
  const char* outcome() const;
};

struct BenchReport {
  std::string suite = {};
  std::vector<BenchRow> rows = {};
  // One line for each wrong answer. Any of them fails the run, because times are noisy but answers
  // are not.
  std::vector<std::string> wrong_answers = {};
  std::string above = {}, below = {};  // tables of the suite, above and below the rows
  // The fields that the suite adds to the JSON, by name: lists of objects, but for `detector`.
  std::map<std::string, nlohmann::ordered_json, std::less<>> figures = {};
  // The suite's own CSV: the names of its columns, and its lines with the number of columns that
  // each has; the others of a line are empty. No lines: the CSV is of the samples of the rows.
  std::vector<std::string> columns = {};
  std::vector<std::pair<std::size_t, std::string>> samples = {};

  void add(std::string label, std::string unit, Estimate measured,
           std::optional<Wanted> wanted = std::nullopt, std::string note = {});
  // Adds a row that says that the folder or file `missing` is not there.
  void add_no_data(std::string label, const std::string& missing);
  // Adds a line to `samples`. A field that is an object itself has a column for each of its own
  // fields ("late_steps"). Numbers of a list are separated by blanks; other lists are left out.
  void add_sample(const nlohmann::ordered_json& object);
  // Adds a row without a measurement. `why` is its note, such as "left out: ...".
  void add_left_out(std::string label, std::string why);
};

std::string text_of(const Wanted& wanted);

// A word of a table, the heading of its column, and the width that it fills. A word ends at the
// right of its column, or begins at the left if the width is below 0. The last column has width 0
// or above; where its word is empty, the line ends before it.
struct Column {
  std::string heading;
  int width;
  std::string word;
};

// The headings of the first row, and all rows, a line each, with `gap` blanks between columns.
// Nothing without rows.
std::string table_text(const std::vector<std::vector<Column>>& rows, int gap = 1);

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

// An object with these fields: a name and its value in turn. What is not there is null.
template <class T, class... Rest>
nlohmann::ordered_json json_object(const char* name, const T& value, const Rest&... rest) {
  nlohmann::ordered_json json;
  if constexpr (requires { value.has_value(); })
    json[name] = value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  else
    json[name] = value;
  if constexpr (sizeof...(rest) > 0) json.update(json_object(rest...));
  return json;
}

}  // namespace assay::reports
