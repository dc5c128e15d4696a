// Suite `stability` finds where each arithmetic breaks, in each family of hard cases of the corpus:
// at all strengths, and after changes of the case that must not change its answer.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "detector/mesh/topology.h"
#include "oracle/view/view_sign.h"
#include "properties/changes/changes.h"
#include "properties/judging/case_options.h"
#include "properties/laws/metamorphic/change_laws.h"
#include "properties/random.h"
#include "reports/bench/compared/comparison.h"

namespace assay::reports {
namespace {

using detector::Arithmetic, detector::ViewSign, properties::Outcome;

// The results of one subject: in a case, in a family at one strength (a cell of the heat map), or
// in a whole family.
struct Cell {
  // All arithmetics are judged by the claims of exact arithmetic. A case counts as a step.
  properties::StepErrors errors = {};
  // The answer and the set of pairs are the oracle's, and if the case gives the view primitive, no
  // triangle is wrongly V+ or V-. (The detector's own primitives may lie on the surface, which only
  // some families test.)
  std::uint64_t right = 0;
  // In addition, every time is the enclosure of exact arithmetic and every sign is the oracle's.
  std::uint64_t exactly_right = 0;
  std::uint64_t refuted = 0;      // a claim of the arithmetic is broken, or a sign is wrong
  std::uint64_t wrong_signs = 0;  // a triangle is wrongly V+ or V-
  detector::ContactRungCounts rungs = {};  // of elementary tests that axis order did not settle
  detector::ViewCounts views = {};
  std::string first_wrong = {}, first_refuted = {};  // ids of cases; empty: none

  Cell& operator+=(const Cell& other) {
    for (const auto member :
         {&Cell::right, &Cell::exactly_right, &Cell::refuted, &Cell::wrong_signs})
      this->*member += other.*member;
    errors += other.errors;
    rungs += other.rungs;
    views += other.views;
    if (first_wrong.empty()) first_wrong = other.first_wrong;
    if (first_refuted.empty()) first_refuted = other.first_refuted;
    return *this;
  }
};

// The results in a family.
struct FamilyCells {
  const corpus::HardFamily& family;
  const BenchSubject& subject;
  std::map<int, Cell> cells = {};  // by strength

  std::string label() const { return fmt::format("{}, {}", family.name, subject.name); }
  Arithmetic arithmetic() const { return subject.options.arithmetic; }
  Cell total() const {
    Cell sum;
    for (const auto& [strength, cell] : cells) sum += cell;
    return sum;
  }
  // Returns the least strength at which a case is not right; or the end.
  auto breaks_at() const {
    return std::find_if(cells.begin(), cells.end(),
                        [](const auto& one) { return one.second.right < one.second.errors.steps; });
  }
};

// How many answers stay the same under a change, among the cases in which the change is exact.
struct Survival {
  std::uint64_t changes = 0, same = 0;
};
using Survivals = std::vector<std::vector<Survival>>;  // [change][subject]

// Returns the exact signs as seen from these primitives, one primitive for each component.
std::vector<ViewSign> signs_from(const std::vector<detector::ViewPrimitive>& primitives,
                                 const corpus::Case& c) {
  const auto mesh = detector::make_topology(c.triangles, c.frames[0].rows());
  std::vector<detector::ViewPrimitive> of_triangle;
  for (const auto component : mesh.component_of_triangle)
    of_triangle.push_back(primitives[static_cast<std::size_t>(component)]);
  return oracle::view_signs({c.frames[0], c.frames[1]}, c.triangles, of_triangle);
}

// Returns whether the oracle agrees with the case's construction: answer, first time, view signs.
bool agrees_with_construction(const corpus::Case& c, const oracle::StepJudgement& judgement) {
  const auto& step = c.expected.steps.front();
  const auto view = corpus::view_of_step(c, 0);
  return judgement.answer == step.answer &&
         (!step.first_time || judgement.first == *step.first_time) &&
         (!step.view_signs || oracle::view_signs({c.frames[0], c.frames[1]}, c.triangles,
                                                 {&*view, 1}) == *step.view_signs);
}

Cell cell_of(const Match& match, std::size_t subject) {
  const auto& [e, outcome, own] = match.verdicts[subject];
  const auto& result = match.runs[subject].first->steps[0];
  bool has_all_signs = true, is_wrong = false;
  if (!result.signs.empty()) {
    const auto signs = signs_from(result.primitives, match.c);
    for (std::size_t t = 0; t < signs.size(); ++t) {
      has_all_signs &= result.signs[t] == signs[t];
      is_wrong |= result.signs[t] != signs[t] && result.signs[t] != ViewSign::zero;
    }
  }
  const bool finds_all = e.undecided + e.missed + e.missing + e.alarming == 0,
             is_right = finds_all && !(is_wrong && match.c.view),
             is_exact = is_right && has_all_signs && outcome == Outcome::holds,
             is_refuted = is_wrong || own != Outcome::holds;
  Cell cell{
      e, is_right, is_exact, is_refuted, is_wrong, result.counts.narrow.rungs, result.counts.view};
  if (!is_exact) cell.first_wrong = match.c.id;
  if (is_refuted) cell.first_refuted = match.c.id;
  return cell;
}

// Plays the case in all changes.
void add_changes(const Match& match, Survivals& survivals) {
  // Crowds of more triangles than this take long, so they are run as they are and not changed.
  constexpr Eigen::Index most_triangles_changed = 600;
  if (match.c.triangles.rows() > most_triangles_changed) return;
  for (std::size_t k = 0; k < survivals.size(); ++k) {
    auto form = case_changes()[k].second(match.c);
    if (!form) continue;
    const auto runs = sweep(form->c, match.subjects, {.rounds = 0});
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const auto& options = match.subjects[i].configuration.options;
      form->same_times = options.arithmetic == Arithmetic::exact;
      const auto &before = match.runs[i].first->steps[0], &after = runs[i].first->steps[0];
      const bool are_refused = before.problem && after.problem;
      const bool is_same =
          are_refused || properties::difference_in_form(before, *form, after).empty();
      ++survivals[k][i].changes;
      survivals[k][i].same += is_same ? 1 : 0;
    }
  }
}

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 100;
}

Estimate number(std::uint64_t count) { return exactly(static_cast<double>(count)); }

std::string break_text(const FamilyCells& row) {
  const auto& family = row.family;
  const auto knob = [&](int strength) {
    if (family.touches(strength)) return std::string("0 (touching)");
    return fmt::format("2^{}{}{}", family.exponent(strength), family.unit.empty() ? "" : " ",
                       family.unit);
  };
  const auto at = row.breaks_at();
  if (at == row.cells.end())
    return fmt::format("never wrong, {} to {}", family.knob, knob(family.last_strength()));
  const auto text = fmt::format("{} {}", family.knob, knob(at->first));
  return at == row.cells.begin() ? "wrong at the first strength, " + text
                                 : fmt::format("{}, right at {}", text, knob(std::prev(at)->first));
}

// Returns how far first times are off, at most and at the median.
std::string time_text(const char* side, const properties::TimesOff& off) {
  if (off.steps == 0) return "";
  return fmt::format(
      "; first time {} in {} steps: at most by {:.1e} of the step ({:.1e} ulp), median {:.1e}",
      side, off.steps, off.worst_share, off.worst_ulps, off.quantile(0.5));
}

nlohmann::ordered_json json_of(const FamilyCells& row, int strength, const Cell& cell) {
  const auto& family = row.family;
  const auto exponent =
      family.touches(strength) ? std::nullopt : std::optional(family.exponent(strength));
  const auto knob =
      fmt::format("{}{}{}", family.knob, family.unit.empty() ? "" : ", ", family.unit);
  const auto cases = cell.errors.steps;
  return json_object("family", family.name, "arithmetic", row.subject.name, "strength", strength,
                     "exponent", exponent, "knob", knob, "cases", cases, "right", cell.right,
                     "share_right", static_cast<double>(cell.right) / static_cast<double>(cases),
                     "exactly_right", cell.exactly_right, "wrong_signs", cell.wrong_signs, "errors",
                     cell.errors);
}

void add_family_rows(const FamilyCells& row, BenchReport& report) {
  const auto all = row.total();
  const auto& e = all.errors;
  const auto label = row.label();
  const auto note = fmt::format(
      "breaks: {}; of {} steps {} unsafe ({} missed, {} late), {} alarming, {} wrong V+ or V-{}{}",
      break_text(row), e.steps, e.unsafe, e.missed, e.late.steps, e.alarming, all.wrong_signs,
      time_text("late", e.late), time_text("early", e.early));
  if (row.arithmetic() == Arithmetic::exact) {
    report.add(label + ": wrong", "steps", number(e.steps - all.exactly_right), at_most(0), note);
    if (!all.first_wrong.empty())
      report.wrong_answers.push_back(label + ": first wrong in " + all.first_wrong);
  } else {
    if (row.arithmetic() == Arithmetic::bounded) {
      report.add(label + ": missed, late, wrong V+ or V-", "steps", number(all.refuted),
                 at_most(0));
      if (!all.first_refuted.empty())
        report.wrong_answers.push_back(label + ": missed or late in " + all.first_refuted);
    }
    report.add(label + ": right", "%", exactly(percent(all.right, e.steps)), {}, note);
  }
  for (const auto& [strength, cell] : row.cells) {
    report.figures["heat"].push_back(json_of(row, strength, cell));
    report.add_sample(report.figures["heat"].back());
  }
}

// Adds which rung settled the elementary tests and the view tests of one family.
void add_rung_rows(const FamilyCells& row, BenchReport& report) {
  if (row.arithmetic() != Arithmetic::exact && row.arithmetic() != Arithmetic::bounded) return;
  const auto all = row.total();
  const auto& r = all.rungs;
  const auto share = [&](std::uint64_t n) { return percent(n, r.total()); };
  if (r.total() > 0) {
    report.add(
        row.label() + ": elementary tests settled by the filter", "%", exactly(share(r.filter)), {},
        fmt::format("of {}; axis {:.1f} %, fixed {:.1f} %, unbounded {:.1f} %, left open {:.1f} %",
                    r.total(), share(r.axis), share(r.fixed), share(r.unbounded), share(r.open)));
  }
  const auto& v = all.views;
  const auto views = v.lanes + v.filter + v.exact + v.open;
  if (views > 0) {
    report.add(row.label() + ": view tests settled by lanes or filter", "%",
               exactly(percent(v.lanes + v.filter, views)), {},
               fmt::format("of {}; integers {:.1f} %, left open {:.1f} %", views,
                           percent(v.exact, views), percent(v.open, views)));
  }
}

void add_survival_rows(const std::vector<BenchSubject>& subjects, const Survivals& survivals,
                       BenchReport& report) {
  for (std::size_t k = 0; k < survivals.size(); ++k) {
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      const auto& [changes, same] = survivals[k][i];
      const bool must = subjects[i].options.arithmetic == Arithmetic::exact;
      const auto label = fmt::format("answers that survive the change {}, {}",
                                     case_changes()[k].first, subjects[i].name);
      report.add(
          label, "%", exactly(percent(same, changes)), goal_if(must, at_least(100)),
          fmt::format("{} of {} changed steps{}", same, changes, must ? ", times included" : ""));
      if (must && same < changes) report.wrong_answers.push_back(label + ": some do not");
    }
  }
}

// Returns whether a strength takes part. All do; with --quick only some, always the strongest and
// touching. Strengths with larger meshes are left out.
bool takes_strength(const corpus::HardFamily& family, int strength, const BenchSettings& settings) {
  constexpr int most_triangles = 5000, steps_when_quick = 4;
  const int step = settings.is_quick() ? std::max(1, family.strongest / steps_when_quick) : 1;
  if (strength < family.strongest && strength % step != 0) return false;
  return corpus::hard_case(family, strength, 0).triangles.rows() <=
         settings.triangles(most_triangles);
}

// Returns all kinds of the family at one strength, in several rounds.
CaseFamily cases_at(const corpus::HardFamily& family, int strength, bool is_quick) {
  const int rounds = family.touches(strength) ? (is_quick ? 2 : 10) : (is_quick ? 1 : 2);
  return {std::string(family.name), "hard", 0, [&family, strength, rounds] {
            std::vector<BenchCase> cases;
            for (int v = 0; v < rounds * family.kinds_at(strength); ++v) {
              auto& entry = cases.emplace_back();
              entry.c = corpus::hard_case(family, strength, v);
              if (entry.c.options.contains("culling"))
                entry.culling = properties::options_of(entry.c).culling;
            }
            return cases;
          }};
}

}  // namespace

std::vector<BenchSubject> all_arithmetics() {
  std::vector<BenchSubject> subjects;
  for (const auto arithmetic : all_values<Arithmetic>) {
    subjects.push_back(variant_of(arithmetic, detector::Culling::view_point, detector::Pairs::all));
    subjects.back().name = name_of(arithmetic);
  }
  return subjects;
}

BenchReport stability_of(std::span<const corpus::HardFamily> families,
                         const std::vector<BenchSubject>& subjects, const BenchSettings& settings,
                         const BenchProgress& progress) {
  BenchReport report{"stability"}, of_comparison;
  std::vector<std::vector<FamilyCells>> all;  // [family][subject]
  Survivals survivals(case_changes().size(), std::vector<Survival>(subjects.size()));
  int strength = 0;
  ComparisonPlan plan;
  plan.on_case = [&](const Match& match) {
    for (std::size_t i = 0; i < subjects.size(); ++i)
      all.back()[i].cells[strength] += cell_of(match, i);
    add_changes(match, survivals);
    if (!agrees_with_construction(match.c, match.truth[0]))
      report.wrong_answers.push_back(
          match.c.id + ": the oracle contradicts the answer for which the case was built");
  };
  Comparison comparison(subjects, plan, of_comparison, progress);
  for (const auto& family : families) {
    auto& row = all.emplace_back();
    for (const auto& subject : subjects) row.push_back({family, subject});
    for (strength = 0; strength <= family.last_strength(); ++strength) {
      if (takes_strength(family, strength, settings))
        comparison.run({cases_at(family, strength, settings.is_quick())});
    }
    for (const auto& of_subject : row) add_family_rows(of_subject, report);
  }
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    std::vector<std::string_view> never_wrong;
    for (const auto& row : all) {
      if (row[i].breaks_at() == row[i].cells.end()) never_wrong.push_back(row[i].family.name);
    }
    report.add("families in which " + subjects[i].name + " is never wrong", "",
               number(never_wrong.size()), {},
               fmt::format("of {}: {}", all.size(), fmt::join(never_wrong, ", ")));
  }
  add_survival_rows(subjects, survivals, report);
  for (const auto& row : all) {
    for (const auto& of_subject : row) add_rung_rows(of_subject, report);
  }
  return report;
}

BenchReport stability_suite(const BenchSettings& settings, const BenchProgress& progress) {
  return stability_of(corpus::hard_families(), all_arithmetics(), settings, progress);
}

namespace {

using properties::Form, properties::Random;

properties::Numbers reordered(Random& random, Eigen::Index rows) {
  const auto in_order = properties::in_order(static_cast<std::size_t>(rows));
  auto order = properties::shuffled(random, in_order);
  // If there are few numbers, shuffling may have left their order as it was. Then it is reversed.
  if (order == in_order) std::reverse(order.begin(), order.end());
  return order;
}

std::optional<Form> permuted(const corpus::Case& c) {
  Random random(c.id);
  const auto vertices = reordered(random, c.frames[0].rows());
  const auto triangles = reordered(random, c.triangles.rows());
  return properties::renumbered(random, c, vertices, triangles);
}

std::optional<Form> in_order(const std::optional<corpus::Case>& c) {
  return c ? std::optional(properties::unchanged(*c)) : std::nullopt;
}

std::optional<Form> mirrored(const corpus::Case& c) {
  return in_order(properties::mirrored(c, Random(c.id).below(3)));
}

std::optional<Form> scaled(const corpus::Case& c) {
  return in_order(properties::scaled(c, Random(c.id).one_in(2) ? 7 : -7));
}

std::optional<Form> translated(const corpus::Case& c) {
  Random random(c.id);
  const double largest = c.frames[0].cwiseAbs().maxCoeff();
  if (!(largest > 0)) return std::nullopt;
  const int sign[] = {random.one_in(2) ? 1 : -1, random.one_in(2) ? 1 : -1,
                      random.one_in(2) ? 1 : -1};
  // The shift has three different multiples of one power of two. They reach from well above the
  // mesh down to its last bits.
  const int top = std::ilogb(largest) + 2;
  for (int exponent = top; exponent > top - 60; --exponent) {
    const double unit = std::ldexp(1, exponent);
    if (unit == 0) break;
    const detector::Point by = {3 * sign[0] * unit, sign[1] * unit, 5 * sign[2] * unit};
    if (const auto copy = properties::translated(c, by)) return in_order(copy);
  }
  return std::nullopt;
}

}  // namespace

std::span<const std::pair<const char*, MakeForm>> case_changes() {
  static constexpr std::pair<const char*, MakeForm> all[] = {{"permutation", permuted},
                                                             {"mirror", mirrored},
                                                             {"power of two", scaled},
                                                             {"translation", translated}};
  return all;
}

}  // namespace assay::reports
