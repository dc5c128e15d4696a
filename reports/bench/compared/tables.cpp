#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "properties/campaign/ledger/binding.h"
#include "reports/bench/compared/comparison.h"

namespace assay::reports {

using Json = nlohmann::ordered_json;

namespace {

// Returns the number of steps; the median and the largest share of a step; the largest in ulps.
std::string time_text(const properties::TimesOff& off) {
  if (off.steps == 0) return "0";
  return fmt::format("{}: {:.2g}, {:.2g} ({:.1g} ulp)", off.steps, off.quantile(0.5),
                     off.worst_share, off.worst_ulps);
}

// The subjects for which a column is shown: those in this process, those in workers, or both.
enum class Of : unsigned char { both, here, workers };

// Returns the columns of a row. A star marks the Pareto line, and brackets mark a count about which
// the detector promised nothing.
std::vector<Column> columns_of(const SubjectRow& row, const std::string& heading,
                               bool has_workers) {
  const auto& e = row.counts.errors;
  const auto& subject = *row.subject;
  const auto text = [](std::uint64_t count) { return std::to_string(count); };
  const auto starred = [&](std::uint64_t count, const ShareOfSteps& share) {
    return text(count) + (share.on_pareto_line ? " *" : subject.is_here ? "  " : "");
  };
  const auto words_of = [&](std::uint64_t count, const std::string& words) {
    return count == 0 || subject.error_claims.has(properties::Claim::free_sound)
               ? words
               : "(" + words + ")";
  };
  const auto answers = [&](const char* what, const char* mark, const char* otherwise) {
    return row.answers.find(what) != std::string::npos ? mark : otherwise;
  };
  const auto over = row.over.value_or(Estimate());
  const std::pair<Of, Column> all[] = {
      {Of::both, {heading, has_workers ? -37 : -29, subject.name}},
      {Of::workers,
       {"answer", -7,
        fmt::format("a{}{}", answers("time", " t", "  "), answers("pairs", " p", ""))}},
      {Of::both,
       {"time", -19,
        row.over ? fmt::format("{:.2f} [{:.2f}, {:.2f}]", over.value, over.lo, over.hi) : "-"}},
      {Of::both, {"unsafe", 9, words_of(e.unsafe, starred(e.unsafe, row.unsafe))}},
      {Of::here, {"alarming", 9, starred(e.alarming, row.alarming)}},
      {Of::both, {"missed", 7, words_of(e.missed, text(e.missed))}},
      {Of::both, {"alarms", 7, text(e.false_alarms)}},
      {Of::here, {"missing", 8, text(e.missing)}},
      {Of::here, {"spurious", 9, text(e.spurious)}},
      {Of::here, {"  late", -31, "  " + time_text(e.late)}},
      {Of::here, {"early", 0, time_text(e.early)}},
      {Of::workers, {"late", 10, text_of(e.late)}},
      {Of::workers, {"early", 10, text_of(e.early)}},
      {Of::workers, {"undecided", 10, text(e.undecided)}},
      {Of::workers, {"slow", 5, text(row.counts.slow)}},
      {Of::workers, {"steps", 6, text(e.steps)}},
      {Of::workers, {"create", 7, row.create_over ? fmt::format("{:.2g}", *row.create_over) : "-"}},
      {Of::workers,
       {"bytes", 6, row.bytes_a_triangle ? fmt::format("{:.0f}", *row.bytes_a_triangle) : "-"}}};
  std::vector<Column> columns;
  for (const auto& [of, column] : all) {
    if (of != (has_workers ? Of::here : Of::workers)) columns.push_back(column);
  }
  return columns;
}

}  // namespace

std::string subjects_text(std::span<const SubjectRow> rows, const std::string& heading) {
  const bool has_workers =
      std::any_of(rows.begin(), rows.end(), [](const auto& row) { return !row.subject->is_here; });
  std::vector<std::vector<Column>> table;
  for (const auto& row : rows) table.push_back(columns_of(row, heading, has_workers));
  auto text = table_text(table, 0);
  if (!has_workers) return text;
  JudgedCounts of[2];  // of peers; of the built-in detector
  for (const auto& row : rows) of[row.subject->detector.built_in ? 1 : 0] += row.counts;
  return text +
         "answer: a (collision or not), t (first time), p (pairs); by the detector's contract\n"
         "time, create: ratio to `built-in, exact, bvh` on the same steps, median over families\n"
         "(n): free-sound is not claimed; late, early: number of steps, worst share of a step\n"
         "slow: cases with a step over 5 s, run only once; bytes: peak memory a triangle\n" +
         fmt::format(
             "unsafe answers confirmed by referee or rational witness: {} of {}, built-in "
             "{} of {}\n",
             of[0].confirmed, of[0].errors.unsafe, of[1].confirmed, of[1].errors.unsafe);
}

std::string remarks_text(const Comparison& comparison, std::span<const AbsentPeer> absent) {
  std::string text;
  for (const auto& row : comparison.rows()) {
    if (row.counts.ended > 0)
      text += fmt::format("ended early: {}, {}: {} of {} cases; the first of them is {}\n",
                          row.subject, row.family, row.counts.ended, row.cases, row.first_end);
  }
  for (const auto& [name, why] : absent) text += fmt::format("absent: {}: {}\n", name, why);
  for (const auto& one : comparison.unsafe()) {
    if (!one.is_confirmed)
      text += fmt::format("unsafe, by the oracle only: {}, case {}, step {}: {}\n", one.subject,
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
  return json_object(
      "subject", subject.name, "version", subject.description.version, "is_built_in",
      subject.detector.built_in, "arithmetic", name_of(subject.options.arithmetic), "culling",
      name_of(subject.options.culling), "pairs", name_of(subject.options.pairs), "claims",
      words_of(subject.detector.claims), "contract", phrases_of(subject.detector.contract),
      "answers", row.answers, "time_over_reference", row.over, "create_over_reference",
      row.create_over, "families_timed", row.families, "slow", row.counts.slow, "ended_early",
      row.counts.ended, "bytes_a_triangle", row.bytes_a_triangle, "unsafe", json_of(row.unsafe),
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
                     f.cases_timed, "slow", f.counts.slow, "ended_early", f.counts.ended,
                     "first_end", f.first_end.empty() ? std::nullopt : std::optional(f.first_end),
                     "broken", f.breaches, "counts", json_of(f.counts));
}

}  // namespace

void add_figures(std::span<const SubjectRow> rows, const Comparison& comparison,
                 BenchReport& report) {
  for (const auto& row : rows) report.figures["subjects"].push_back(json_of(row));
  for (const auto& row : comparison.rows()) report.figures["families"].push_back(json_of(row));
  for (const auto& one : comparison.unsafe())
    report.figures["unsafe_answers"].push_back(
        json_object("subject", one.subject, "case", one.case_id, "step", one.step + 1, "what",
                    one.defect, "confirmed", one.is_confirmed));
}

}  // namespace assay::reports
