#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "reports/bench/compared/comparison.h"

namespace assay::reports {

using Json = nlohmann::ordered_json;

const char* BenchRow::outcome() const {
  if (!estimate) return "no data";
  if (!goal) return "-";
  const double x = estimate->value, bound = goal->bound;
  return (goal->is_most ? x <= bound : x >= bound) ? "holds" : "fails";
}

void BenchReport::add(std::string label, std::string unit, Estimate estimate,
                      std::optional<Goal> goal, std::string note) {
  rows.push_back({std::move(label), std::move(unit), std::move(estimate), goal, std::move(note)});
}

void BenchReport::add_no_data(std::string label, const std::string& missing) {
  add_left_out(std::move(label), missing + " is not there");
}

void BenchReport::add_left_out(std::string label, std::string why) {
  rows.push_back({std::move(label), {}, {}, {}, std::move(why)});
}

std::string text_of(const Goal& goal) {
  return fmt::format("{} {:g}", goal.is_most ? "<=" : ">=", goal.bound);
}

std::string text_of(const properties::TimesOff& off) {
  return off.steps == 0 ? "0" : fmt::format("{}: {:.1g}", off.steps, off.worst_share);
}

std::string table_text(const std::vector<std::vector<Column>>& rows, int gap) {
  std::string text;
  const auto add_line = [&](const std::vector<Column>& row, std::string Column::*word) {
    for (const auto& column : row) {
      if (&column == &row.back() && (column.*word).empty()) break;
      if (&column != &row.front()) text.append(static_cast<std::size_t>(gap), ' ');
      const auto width = static_cast<std::size_t>(std::abs(column.width));
      const std::string fill(width - std::min(width, (column.*word).size()), ' ');
      text += column.width < 0 ? column.*word + fill : fill + column.*word;
    }
    text += "\n";
  };
  if (!rows.empty()) add_line(rows[0], &Column::heading);
  for (const auto& row : rows) add_line(row, &Column::word);
  return text;
}

namespace {

std::string measured_text(const BenchRow& row) {
  if (!row.estimate) return "-";
  const auto& m = *row.estimate;
  std::string text = fmt::format("{:.4g}", m.value);
  if (!row.unit.empty()) text += " " + row.unit;
  if (m.lo < m.hi) text += fmt::format(" [{:.4g}, {:.4g}]", m.lo, m.hi);
  return text;
}

std::string rows_text(const std::vector<BenchRow>& rows) {
  std::size_t widest = 4, width_of_estimate = 8;
  for (const auto& row : rows) {
    widest = std::max(widest, row.label.size());
    width_of_estimate = std::max(width_of_estimate, measured_text(row).size());
  }
  std::vector<std::vector<Column>> table;
  for (const auto& row : rows)
    table.push_back({{"what", -static_cast<int>(widest), row.label},
                     {"measured", -static_cast<int>(width_of_estimate), measured_text(row)},
                     {"wanted", -10, row.goal ? text_of(*row.goal) : "-"},
                     {"outcome", 0, row.outcome()},
                     {"", 0, row.note}});
  return table_text(table, 2);
}

}  // namespace

std::string text_of(const BenchReport& report) {
  std::string text = report.above + rows_text(report.rows) + report.below;
  for (const auto& line : report.wrong_answers) text += "WRONG ANSWER: " + line + "\n";
  return text;
}

void to_json(Json& json, const Estimate& estimate) {
  json = {{"median", estimate.value},
          {"interval", {estimate.lo, estimate.hi}},
          {"samples", estimate.samples}};
}

Json to_json(const BenchReport& report, const std::string& version) {
  Json rows = Json::array();
  for (const auto& row : report.rows) {
    const auto goal_text = row.goal ? std::optional(text_of(*row.goal)) : std::nullopt;
    rows.push_back(json_object("what", row.label, "unit", row.unit, "measured", row.estimate,
                               "wanted", goal_text, "outcome", row.outcome(), "note", row.note));
  }
  Json json = json_object("schema", "assay-bench/2", "version", version, "suite", report.suite,
                          "rows", rows);
  // Every suite has every field.
  for (const std::string name :
       {"subjects", "families", "heat", "detector", "absent_peers", "unsafe_answers"}) {
    const auto figures = report.figures.find(name);
    json[name] = figures != report.figures.end() ? figures->second
                 : name == "detector"            ? Json()
                                                 : Json::array();
  }
  json["wrong_answers"] = report.wrong_answers;
  return json;
}

namespace {

std::string quoted(const std::string& words) {
  std::string text(1, '"');
  for (const char c : words) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

// Returns a field of the CSV. Words stand in quotes only if they have to.
std::string csv_field(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  if (!value.is_string()) return value.dump();
  const auto words = value.get<std::string>();
  return words.find_first_of(",\"\n") == std::string::npos ? words : quoted(words);
}

using Values = std::map<std::string, std::string>;  // by the name of the column

void add_values(const std::string& name, const Json& value, std::vector<std::string>& columns,
                Values& values) {
  if (value.is_object()) {
    const std::string before = name.empty() ? "" : name + "_";
    for (const auto& [inner, one] : value.items()) add_values(before + inner, one, columns, values);
    return;
  }
  if (value.is_null() || (value.is_array() && !value.empty() && value.front().is_structured()))
    return;
  std::vector<std::string> words;
  for (const auto& one : value) words.push_back(csv_field(one));
  values[name] = fmt::format("{}", fmt::join(words, " "));
  if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
}

}  // namespace

void BenchReport::add_sample(const Json& object) {
  Values values;
  add_values("", object, columns, values);
  std::vector<std::string> line;
  for (const auto& column : columns) line.push_back(values[column]);
  samples.emplace_back(columns.size(), fmt::format("{}", fmt::join(line, ",")));
}

std::string csv_of(const BenchReport& report) {
  std::string text;
  if (!report.samples.empty()) {
    text = fmt::format("{}\n", fmt::join(report.columns, ","));
    for (const auto& [columns, line] : report.samples)
      text += line + std::string(report.columns.size() - columns, ',') + "\n";
    return text;
  }
  text = "suite,what,unit,sample,value\n";
  for (const auto& row : report.rows) {
    int sample = 0;
    for (const double value : row.estimate ? row.estimate->samples : std::vector<double>()) {
      text += fmt::format("{},{},{},{},{}\n", report.suite, quoted(row.label), quoted(row.unit),
                          ++sample, value);
    }
  }
  return text;
}

}  // namespace assay::reports
