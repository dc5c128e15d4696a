#include "reports/bench/bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "properties/words.h"
#include "reports/bench/detector/compared_output.h"
#include "reports/bench/peers/peer_output.h"
#include "reports/bench/speed_error/error_output.h"
#include "reports/bench/stability/stability_output.h"
#include "reports/terminal/version.h"

namespace assay::reports {

using Json = nlohmann::ordered_json;

RowOutcome BenchRow::outcome() const {
  if (!measured) return RowOutcome::no_data;
  if (!wanted) return RowOutcome::not_judged;
  const double x = measured->value, bound = wanted->bound;
  const bool holds = wanted->sense == Wanted::Sense::at_most    ? x <= bound
                     : wanted->sense == Wanted::Sense::at_least ? x >= bound
                                                                : x < bound;
  return holds ? RowOutcome::holds : RowOutcome::fails;
}

void BenchReport::add(std::string label, std::string unit, Estimate measured,
                      std::optional<Wanted> wanted, std::string note) {
  rows.push_back({std::move(label), std::move(unit), std::move(measured), wanted, std::move(note)});
}

void BenchReport::add_no_data(std::string label, const std::string& missing) {
  add_left_out(std::move(label), missing + " is not there");
}

void BenchReport::add_left_out(std::string label, std::string why) {
  rows.push_back({std::move(label), {}, {}, {}, std::move(why)});
}

const char* name_of(RowOutcome outcome) {
  return properties::word_of({"holds", "fails", "-", "no data"}, outcome);
}

std::string text_of(const Wanted& wanted) {
  const char* sign = wanted.sense == Wanted::Sense::at_most    ? "<="
                     : wanted.sense == Wanted::Sense::at_least ? ">="
                                                               : "<";
  return fmt::format("{} {:g}", sign, wanted.bound);
}

namespace {

std::string measured_text(const BenchRow& row) {
  if (!row.measured) return "-";
  const auto& m = *row.measured;
  std::string text = fmt::format("{:.4g}", m.value);
  if (!row.unit.empty()) text += " " + row.unit;
  if (m.lo < m.hi) text += fmt::format(" [{:.4g}, {:.4g}]", m.lo, m.hi);
  return text;
}

}  // namespace

std::string text_of(const BenchReport& report) {
  std::size_t widest = 4, measured = 8;
  for (const auto& row : report.rows) {
    widest = std::max(widest, row.label.size());
    measured = std::max(measured, measured_text(row).size());
  }
  std::string text;
  if (report.detector) text = text_of(*report.detector, report.sequences);
  if (!report.rows.empty())
    text += fmt::format("{:<{}}  {:<{}}  {:<10}  {}\n", "what", widest, "measured", measured,
                        "wanted", "outcome");
  for (const auto& row : report.rows) {
    text += fmt::format("{:<{}}  {:<{}}  {:<10}  {}{}\n", row.label, widest, measured_text(row),
                        measured, row.wanted ? text_of(*row.wanted) : "-", name_of(row.outcome()),
                        row.note.empty() ? "" : "  " + row.note);
  }
  if (!report.variants.empty()) {
    text += fmt::format("\n{}\n{}\n", families_text(report.families),
                        text_of(std::span(report.variants)));
  }
  if (!report.peers.empty()) {
    text += text_of(std::span(report.peers), std::span(report.peer_families),
                    std::span(report.absent_peers));
    text += unconfirmed_text(report.unsafe_answers);
  }
  for (const auto& line : report.wrong_answers) text += "WRONG ANSWER: " + line + "\n";
  return text;
}

Json to_json(const BenchReport& report) {
  Json rows = Json::array(), scatter = Json::array();
  for (const auto& row : report.rows) {
    Json measured, wanted;
    if (row.measured) measured = to_json(*row.measured);
    if (row.wanted) wanted = text_of(*row.wanted);
    rows.push_back({{"what", row.label},
                    {"unit", row.unit},
                    {"measured", measured},
                    {"wanted", wanted},
                    {"outcome", name_of(row.outcome())},
                    {"note", row.note}});
  }
  for (const auto& p : report.scatter) {
    scatter.push_back({{"scene", p.scene},
                       {"culling", p.culling},
                       {"view_positive_share", p.share},
                       {"over", p.over},
                       {"time_over", p.ratio},
                       {"interval", {p.lo, p.hi}}});
  }
  return {{"schema", "assay-bench/1"},
          {"version", version_text()},
          {"suite", report.suite},
          {"rows", rows},
          {"scatter", scatter},
          {"heat", to_json(std::span(report.heat))},
          {"variants", to_json(std::span(report.variants))},
          {"families", to_json(std::span(report.families))},
          {"detector", report.detector ? to_json(*report.detector) : Json()},
          {"sequences", to_json(std::span(report.sequences))},
          {"peers", to_json(std::span(report.peers))},
          {"peer_families", to_json(std::span(report.peer_families))},
          {"absent_peers", to_json(std::span(report.absent_peers))},
          {"unsafe_answers", to_json(std::span(report.unsafe_answers))},
          {"wrong_answers", report.wrong_answers}};
}

namespace {

// A field of CSV. It stands in quotes, because the words may hold commas.
std::string quoted(const std::string& words) {
  std::string text(1, '"');
  for (const char c : words) text.append(c == '"' ? 2 : 1, c);
  text += '"';
  return text;
}

}  // namespace

std::string csv_of(const BenchReport& report) {
  if (!report.steps.empty()) return csv_of(std::span(report.steps));
  if (!report.heat.empty()) return csv_of(std::span(report.heat));
  if (!report.peers.empty()) return csv_of(std::span(report.peer_families));
  if (report.detector) return csv_of(std::span(report.sequences));
  std::string text = "suite,what,unit,sample,value\n";
  for (const auto& row : report.rows) {
    if (!row.measured) continue;
    int sample = 0;
    for (const double value : row.measured->samples) {
      text += fmt::format("{},{},{},{},{}\n", report.suite, quoted(row.label), quoted(row.unit),
                          ++sample, value);
    }
  }
  return text;
}

}  // namespace assay::reports
