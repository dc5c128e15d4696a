#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "properties/campaign/ledger/binding.h"
#include "reports/bench/compared/comparison.h"

namespace assay::reports {

using Json = nlohmann::ordered_json;

namespace {

// In how many steps; the median and the largest share of a step; the largest in ulps.
std::string time_text(const properties::TimesOff& off) {
  if (off.steps == 0) return "0";
  return fmt::format("{}: {:.2g}, {:.2g} ({:.1g} ulp)", off.steps, off.quantile(0.5),
                     off.worst_share, off.worst_ulps);
}

// A column is shown of subjects in this process, of those in workers, or of both.
struct Column {
  const char* heading;
  int width;
  bool is_of_here = true, is_of_workers = true;
};
constexpr Column columns[] = {{"answer", -7, false},
                              {"time", -19},
                              {"unsafe", 9},
                              {"alarming", 9, true, false},
                              {"missed", 7},
                              {"alarms", 7},
                              {"missing", 8, true, false},
                              {"spurious", 9, true, false},
                              {"  late", -27, true, false},
                              {"early", -1, true, false},
                              {"late", 10, false},
                              {"early", 10, false},
                              {"undecided", 10, false},
                              {"slow", 5, false},
                              {"steps", 6, false},
                              {"create", 7, false},
                              {"bytes", 6, false}};

// In the order of columns. A star stands on the Pareto line, and a count in brackets where the
// detector promised nothing about it.
std::vector<std::string> words_of(const SubjectRow& row) {
  const auto& e = row.counts.errors;
  const auto& subject = *row.subject;
  const auto starred = [&](std::uint64_t count, const ShareOfSteps& share) {
    return fmt::format("{}{}", count, share.on_pareto_line ? " *" : subject.is_here ? "  " : "");
  };
  const auto asked = [&](std::uint64_t count, const std::string& words) {
    return count == 0 || subject.counted.has(properties::Claim::free_sound) ? words
                                                                            : "(" + words + ")";
  };
  const bool tells_time = row.answers.find("time") != std::string::npos,
             tells_pairs = row.answers.find("pairs") != std::string::npos;
  return {fmt::format("a{}{}", tells_time ? " t" : "  ", tells_pairs ? " p" : ""),
          row.over
              ? fmt::format("{:.2f} [{:.2f}, {:.2f}]", row.over->value, row.over->lo, row.over->hi)
              : "-",
          asked(e.unsafe, starred(e.unsafe, row.unsafe)),
          starred(e.alarming, row.alarming),
          asked(e.missed, std::to_string(e.missed)),
          std::to_string(e.false_alarms),
          std::to_string(e.missing),
          std::to_string(e.spurious),
          "  " + time_text(e.late),
          time_text(e.early),
          text_of(e.late),
          text_of(e.early),
          std::to_string(e.undecided),
          std::to_string(row.slow),
          std::to_string(e.steps),
          row.create_over ? fmt::format("{:.2g}", *row.create_over) : "-",
          row.bytes_a_triangle ? fmt::format("{:.0f}", *row.bytes_a_triangle) : "-"};
}

}  // namespace

std::string subjects_text(std::span<const SubjectRow> rows, const std::string& heading) {
  const bool has_workers =
      std::any_of(rows.begin(), rows.end(), [](const auto& row) { return !row.subject->is_here; });
  std::string text;
  const auto add_line = [&](const std::string& name, const std::vector<std::string>& all) {
    std::vector<int> widths = {has_workers ? -37 : -29};
    std::vector<std::string> words = {name};
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!(has_workers ? columns[i].is_of_workers : columns[i].is_of_here)) continue;
      widths.push_back(columns[i].width);
      words.push_back(all[i]);
    }
    text += table_line(widths, words, 0);
  };
  std::vector<std::string> headings;
  for (const auto& column : columns) headings.emplace_back(column.heading);
  add_line(heading, headings);
  for (const auto& row : rows) add_line(row.subject->name, words_of(row));
  if (!has_workers) return text;
  JudgedCounts of[2];  // of peers, of the built-in detector
  for (const auto& row : rows) of[row.subject->detector.built_in ? 1 : 0] += row.counts;
  return text +
         "answer: a collision or not, t when first, p which pairs; each in its own contract\n"
         "time, create (preprocessing): over built-in, exact, bvh, same steps, by families\n"
         "(n): of what was not promised; late, early: steps, and the worst as a share of the step\n"
         "slow: cases with a step of more than 5 s, run once; bytes: a triangle, at the highest\n" +
         fmt::format(
             "unsafe answers confirmed by referee or rational witness: {} of {}, built-in "
             "{} of {}\n",
             of[0].confirmed, of[0].errors.unsafe, of[1].confirmed, of[1].errors.unsafe);
}

std::string remarks_text(const Comparison& comparison, std::span<const AbsentPeer> absent) {
  std::string text;
  for (const auto& row : comparison.rows()) {
    if (row.ended > 0)
      text += fmt::format("ended early: {}, {}: {} of {} cases, first {}\n", row.subject,
                          row.family, row.ended, row.cases, row.first_end);
  }
  for (const auto& [name, why] : absent) text += fmt::format("absent: {}: {}\n", name, why);
  for (const auto& one : comparison.unsafe()) {
    if (!one.is_confirmed)
      text += fmt::format("by the oracle alone: {}, case {}, step {}: {}\n", one.subject,
                          one.case_id, one.step + 1, one.defect);
  }
  return text;
}

namespace {

Json json_of(const JudgedCounts& counts) {
  Json json = counts.errors;
  json["left_out"] = counts.left_out;
  json["confirmed"] = counts.confirmed;
  return json;
}

Json json_of(const ShareOfSteps& share) {
  return json_object("share", share.share, "interval", std::array{share.lo, share.hi},
                     "on_pareto_line", share.on_pareto_line);
}

Json json_of(const SubjectRow& row) {
  const auto& subject = *row.subject;
  return json_object("subject", subject.name, "version", subject.description.version, "is_built_in",
                     subject.detector.built_in, "arithmetic", name_of(subject.options.arithmetic),
                     "culling", name_of(subject.options.culling), "pairs",
                     name_of(subject.options.pairs), "claims", words_of(subject.detector.claims),
                     "contract", phrases_of(subject.detector.contract), "answers", row.answers,
                     "time_over_reference", row.over, "create_over_reference", row.create_over,
                     "families_timed", row.families, "slow", row.slow, "ended_early", row.ended,
                     "bytes_a_triangle", row.bytes_a_triangle, "unsafe", json_of(row.unsafe),
                     "alarming", json_of(row.alarming), "counts", json_of(row.counts));
}

std::optional<Estimate> each(const std::vector<double>& sums, std::uint64_t count) {
  if (sums.empty() || count == 0) return std::nullopt;
  return scaled(bootstrap_median(sums), 1 / static_cast<double>(count));
}

Json json_of(const FamilyRow& f) {
  return json_object("subject", f.subject, "family", f.family, "kind", f.kind, "steps", f.steps,
                     "triangles", f.triangles, "hash", fmt::format("{:016x}", f.hash), "box_tests",
                     f.box_tests, "candidates", f.candidates, "elementary_tests",
                     f.elementary_tests, "ms_a_step", each(f.ms, f.steps_timed),
                     "time_over_reference", f.over(), "create_ms", each(f.create_ms, f.cases_timed),
                     "create_over_reference", f.create_over(), "cases", f.cases, "cases_timed",
                     f.cases_timed, "slow", f.slow, "ended_early", f.ended, "first_end",
                     f.first_end.empty() ? std::nullopt : std::optional(f.first_end), "broken",
                     f.broken, "counts", json_of(f.counts));
}

}  // namespace

void add_figures(std::span<const SubjectRow> rows, const Comparison& comparison,
                 BenchReport& report) {
  for (const auto& row : rows) report.add_figure("subjects", json_of(row));
  for (const auto& row : comparison.rows()) report.add_figure("families", json_of(row));
  for (const auto& one : comparison.unsafe())
    report.add_figure("unsafe_answers",
                      json_object("subject", one.subject, "case", one.case_id, "step", one.step + 1,
                                  "what", one.defect, "confirmed", one.is_confirmed));
}

}  // namespace assay::reports
