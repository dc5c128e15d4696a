#include "reports/vectors/matrix_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<title>Assay vectors: who misses what</title>
<style>
:root { color-scheme: light dark; --ground: #fdfdfc; --text: #1f2328; --quiet: #5b626b;
  --line: #d8dadd; --good: #1a7f37; --bad: #b3261e; --open: #8a5a00; --good-ground: #e9f5ec;
  --bad-ground: #fbe6e4; --open-ground: #faf0da; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #16191d; --text: #e4e6e9; --quiet: #a2a9b3; --line: #373d45; --good: #57c271;
    --bad: #ff8078; --open: #e3b04b; --good-ground: #17281c; --bad-ground: #3a1d1b;
    --open-ground: #33290f; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 80rem; padding: 1.5rem 1rem 3rem; background: var(--ground);
  color: var(--text); font: 15px/1.5 system-ui, "Segoe UI", "Liberation Sans", sans-serif; }
h1 { font-size: 1.5rem; margin: 0; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 .6rem; padding-top: .8rem;
  border-top: 1px solid var(--line); }
h3 { font-size: 1rem; margin: 1.4rem 0 .3rem; }
p, ul { margin: .4rem 0; max-width: 56rem; }
code { font: .87em ui-monospace, "Liberation Mono", monospace; overflow-wrap: anywhere; }
small, .quiet { color: var(--quiet); font-size: .85rem; font-weight: normal; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid var(--line); padding: .35rem .5rem; text-align: right;
  vertical-align: top; }
th:first-child, td.words { text-align: left; }
thead th { vertical-align: bottom; }
.wide { overflow-x: auto; }
.matrix tbody th { min-width: 12rem; }
.matrix thead th:not(:first-child) { min-width: 4.2rem; max-width: 7rem; overflow-wrap: anywhere; }
.matrix small, .chip small { display: block; line-height: 1.3; }
.matrix td { white-space: nowrap; }
.matrix td b, .chip b { font-weight: 600; }
.bad { background: var(--bad-ground); } .bad b { color: var(--bad); }
.open { background: var(--open-ground); } .open b { color: var(--open); }
.good { background: var(--good-ground); } .good b { color: var(--good); }
.none { color: var(--quiet); }
.legend { display: flex; flex-wrap: wrap; gap: .5rem; padding: 0; list-style: none; }
.chip { padding: .25rem .6rem; border: 1px solid var(--line); border-radius: 6px; }
.cases { padding-left: 1.2rem; }
.cases li { margin: .35rem 0; }
@media (max-width: 640px), print {
  thead { display: none; }
  tbody, tr, tbody th { display: block; }
  tr { display: grid; grid-template-columns: repeat(auto-fill, minmax(6.2rem, 1fr)); gap: .25rem;
    padding: .5rem 0; border-bottom: 1px solid var(--line); }
  th, td { border: 0; text-align: left; }
  tbody th, td.words { grid-column: 1 / -1; padding: 0; }
  td[data-of]::before { content: attr(data-of) " "; color: var(--quiet); font-size: .85rem; }
}
@media print {
  body { max-width: none; font-size: 10pt; padding: 0; }
  tr, li, h3 { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  td, .chip { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
</style></head><body>
)";

constexpr const char* legend = R"(<ul class="legend">
<li class="chip bad"><b>&#x2717; 3/17</b> <small>3 of 17 cases missed</small></li>
<li class="chip open"><b>! 0/17</b> <small>none missed, but late times, alarms or answers missing</small></li>
<li class="chip good"><b>&#x2713; 0/17</b> <small>all right</small></li>
<li class="chip none">&ndash; <small>not asked, or not supported</small></li>
</ul>
<p class="quiet">A miss is the answer free where features meet, or a share of a step that is not safe.
A late time is a first time after the contact, be it by the last digit. An alarm is a contact that there
is not. Where features only touch, both answers are right; these are counted below.</p>
)";

std::string escaped(const std::string& text) {
  return replaced(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}});
}

std::string count_text(int count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

// "2 late, 5 alarms": what a cell says below its misses.
std::string others_text(const MatrixCell& cell) {
  std::vector<std::string> words;
  if (cell.late > 0) words.push_back(fmt::format("{} late", cell.late));
  if (cell.alarms > 0) words.push_back(count_text(cell.alarms, "alarm", "alarms"));
  if (cell.unanswered > 0) words.push_back(fmt::format("{} unanswered", cell.unanswered));
  return joined(words, "<br>");
}

std::string cell_html(const MatrixCell& cell, const std::string& letter) {
  if (cell.cases == 0) return fmt::format(R"(<td class="none" data-of="{}">&ndash;</td>)", letter);
  const auto others = others_text(cell);
  const bool misses = cell.misses > 0;
  return fmt::format(R"(<td class="{}" data-of="{}"><b>{} {}/{}</b>{}</td>)",
                     misses           ? "bad"
                     : others.empty() ? "good"
                                      : "open",
                     letter,
                     misses           ? "&#x2717;"
                     : others.empty() ? "&#x2713;"
                                      : "!",
                     cell.misses, cell.cases,
                     others.empty() ? "" : "<small>" + others + "</small>");
}

// `reason` says what stands below the name of a row.
template <class Reason>
std::string matrix_html(const std::string& title, const std::vector<MatrixRow>& rows,
                        const std::vector<JudgedResults>& all, Reason reason) {
  std::string html = fmt::format(
      "<div class=\"wide\"><table class=\"matrix\">\n<thead><tr><th scope=\"col\">{}</th>", title);
  for (std::size_t i = 0; i < all.size(); ++i) {
    html += fmt::format("<th scope=\"col\">{} <small>{}</small></th>", letter_of(i),
                        escaped(all[i].name));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    html += fmt::format("<tr><th scope=\"row\">{}{}</th>", escaped(row.name), reason(row.name));
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      html += cell_html(row.cells[i], letter_of(i));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string products_html(const std::vector<JudgedResults>& all) {
  std::string html =
      "<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">product</th><th>cases</th>"
      "<th>misses</th><th>late</th><th>alarms</th><th>undecided, error</th><th>crash, timeout</th>"
      "<th>unsupported</th></tr></thead>\n<tbody>\n";
  using enum CaseOutcome;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& judged = all[i];
    html += fmt::format(
        "<tr><th scope=\"row\">{} &nbsp;{} {} <small>{}</small></th>"
        "<td data-of=\"cases\">{}</td><td class=\"{}\" data-of=\"misses\"><b>{}</b></td>"
        "<td data-of=\"late\">{}</td><td data-of=\"alarms\">{}</td>"
        "<td data-of=\"undecided, error\">{}</td><td data-of=\"crash, timeout\">{}</td>"
        "<td data-of=\"unsupported\">{}</td></tr>\n",
        letter_of(i), escaped(judged.name), escaped(judged.version), escaped(judged.settings),
        judged.supported(), judged.count(miss) > 0 ? "bad" : "good", judged.count(miss),
        judged.count(late), judged.count(alarm), judged.count(undecided) + judged.count(error),
        judged.count(crash) + judged.count(timeout), judged.count(unsupported));
  }
  return html + "</tbody></table></div>\n";
}

std::string touching_html(const std::vector<JudgedResults>& all) {
  std::string html;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].closed + all[i].open == 0) continue;
    html += fmt::format("<li>{} {}: {} called contact, {} free</li>\n", letter_of(i),
                        escaped(all[i].name), all[i].closed, all[i].open);
  }
  if (html.empty()) return "";
  return "<h2>Where features only touch</h2>\n<p>By closed sets these cases are contacts; who "
         "counts only what overlaps answers free. Both are right, and a product should hold to "
         "one of them.</p>\n<ul>\n" +
         html + "</ul>\n";
}

std::string time_text(const properties::VectorFacts& step) {
  if (!step.first) return "";
  const auto [lo, hi] = *step.first;
  return lo == hi ? fmt::format(" at t = {}", lo) : fmt::format(" between t = {} and {}", lo, hi);
}

std::string answer_text(const properties::VectorAnswer& answer) {
  if (answer.answer == "share") return fmt::format("share {}", *answer.share);
  if (!answer.time) return answer.answer;
  const auto [lo, hi] = *answer.time;
  return lo == hi ? fmt::format("{} at t = {}", answer.answer, lo)
                  : fmt::format("{} between t = {} and {}", answer.answer, lo, hi);
}

std::string case_html(const JudgedCase& one) {
  const auto& asked = *one.asked;
  const auto& step = asked.steps[one.step];
  std::vector<std::string> flags;
  for (const auto flag : asked.flags) flags.emplace_back(name_of(flag));
  return fmt::format("<li><code>{}</code> {}<br><small>{}contact{}; answered {}. {}</small></li>\n",
                     escaped(asked.c.id), escaped(asked.c.about),
                     asked.steps.size() > 1 ? fmt::format("step {}: ", one.step + 1) : "",
                     time_text(step), escaped(answer_text(one.answer)),
                     escaped(joined(flags, ", ")));
}

// The ids of all cases with an outcome that needs no sentence each.
std::string ids_html(const JudgedResults& judged, CaseOutcome outcome, const char* words) {
  const auto cases = judged.with(outcome);
  if (cases.empty()) return "";
  std::string html = fmt::format("<p>{} ({}):", words, cases.size());
  for (const auto* one : cases) html += " <code>" + escaped(one->asked->c.id) + "</code>";
  return html + "</p>\n";
}

std::string product_html(const JudgedResults& judged, const std::string& letter) {
  const auto misses = judged.with(CaseOutcome::miss);
  std::string html = fmt::format(
      "<h3>{} {} {}: {}</h3>\n", letter, escaped(judged.name), escaped(judged.version),
      misses.empty() ? "no miss" : count_text(static_cast<int>(misses.size()), "miss", "misses"));
  if (!misses.empty()) {
    html += "<ul class=\"cases\">\n";
    for (const auto* one : misses) html += case_html(*one);
    html += "</ul>\n";
  }
  for (const auto& [outcome, words] : {std::pair{CaseOutcome::late, "Late times"},
                                       {CaseOutcome::alarm, "Alarms"},
                                       {CaseOutcome::crash, "Crashes"},
                                       {CaseOutcome::timeout, "Timeouts"},
                                       {CaseOutcome::error, "Errors"},
                                       {CaseOutcome::undecided, "Undecided"}})
    html += ids_html(judged, outcome, words);
  if (judged.early > 0) html += fmt::format("<p>Times before the contact: {}</p>\n", judged.early);
  if (judged.gave_pairs) {
    html += fmt::format("<p>Pairs: {} missing, {} spurious</p>\n", judged.missing_pairs,
                        judged.spurious_pairs);
  }
  if (!judged.uses.empty()) html += fmt::format("<p>Limits: {}</p>\n", uses_text(judged));
  return html;
}

}  // namespace

std::string matrix_page(const properties::ReadSet& read, const std::vector<JudgedResults>& all) {
  std::string html = head;
  html += fmt::format(
      "<h1>Who misses what</h1>\n<p>{} small hard cases of continuous collision detection, whose "
      "answers are known exactly. <span class=\"quiet\">Set {} ({}), digest "
      "<code>{}</code></span></p>\n",
      read.set.size(), escaped(read.version), escaped(read.set.profile), escaped(read.digest));
  html += products_html(all);
  html += "<h2>By what makes a case hard</h2>\n";
  html += legend;
  html += matrix_html(
      "flag: what goes wrong", rows_by_flag(read, all), all, [&](const std::string& name) {
        const auto text = std::find_if(read.flags.begin(), read.flags.end(),
                                       [&](const auto& one) { return name_of(one.flag) == name; });
        return "<br><small>" + escaped(text->wrong) + "</small>";
      });
  html += "<h2>By group</h2>\n";
  html +=
      matrix_html("group", rows_by_group(read, all), all, [](const std::string&) { return ""; });
  html += touching_html(all);
  html += "<h2>The misses</h2>\n";
  for (std::size_t i = 0; i < all.size(); ++i) html += product_html(all[i], letter_of(i));
  return html + "</body></html>\n";
}

}  // namespace assay::reports
