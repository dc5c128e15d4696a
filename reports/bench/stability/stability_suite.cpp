// Suite `stability` finds where each arithmetic breaks, in each family of hard cases of the
// corpus.
#include <fmt/format.h>

#include <algorithm>

#include "reports/bench/stability/stability.h"

namespace assay::reports {
namespace {

using detector::Arithmetic;

double percent(double part, double whole) { return whole > 0 ? 100 * part / whole : 100; }

std::string knob_text(const corpus::HardFamily& family, int strength) {
  if (family.touches(strength)) return "0 (touching)";
  return fmt::format("2^{}{}{}", family.exponent(strength), family.unit.empty() ? "" : " ",
                     family.unit);
}

std::string break_text(const corpus::HardFamily& family, const FamilyStability& found) {
  const auto breaks_at = found.breaks_at();
  if (!breaks_at) {
    return fmt::format("never wrong, {} to {}", family.knob,
                       knob_text(family, family.last_strength()));
  }
  if (*breaks_at == found.cells.front().strength) {
    return fmt::format("wrong at once, {} {}", family.knob, knob_text(family, *breaks_at));
  }
  const auto before = std::find_if(found.cells.begin(), found.cells.end(),
                                   [&](const auto& cell) { return cell.strength == *breaks_at; });
  return fmt::format("{} {}, right at {}", family.knob, knob_text(family, *breaks_at),
                     knob_text(family, std::prev(before)->strength));
}

// How far first times are off, at most and at the median.
std::string time_text(const char* side, const properties::TimesOff& off) {
  if (off.steps == 0) return "";
  return fmt::format(
      "; first time {} in {}: largest {:.1e} of the step ({:.1e} ulp), median {:.1e}", side,
      off.steps, off.worst_share, off.worst_ulps, off.quantile(0.5));
}

nlohmann::ordered_json json_of(const StabilityCell& c) {
  const auto exponent = c.touches ? std::nullopt : std::optional(c.exponent);
  return json_object("family", c.family, "arithmetic", c.arithmetic, "strength", c.strength,
                     "exponent", exponent, "knob", c.knob, "cases", c.cases, "right", c.right,
                     "share_right", c.share_right(), "exactly_right", c.exactly_right,
                     "wrong_signs", c.wrong_signs, "errors", c.errors);
}

void add_family_rows(const corpus::HardFamily& family, std::span<const StabilitySubject> subjects,
                     const std::vector<FamilyStability>& found, BenchReport& report) {
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const auto all = found[i].total();
    const std::string label = fmt::format("{}, {}", family.name, subjects[i].name);
    const auto& e = all.errors;
    const std::string note = fmt::format(
        "breaks: {}; of {} steps {} unsafe ({} missed, {} late), {} alarming, {} wrong V+ or "
        "V-{}{}",
        break_text(family, found[i]), all.cases, e.unsafe, e.missed, e.late.steps, e.alarming,
        all.wrong_signs, time_text("late", e.late), time_text("early", e.early));
    if (subjects[i].arithmetic == Arithmetic::exact) {
      report.add(label + ": wrong", "steps", exactly(all.cases - all.exactly_right), at_most(0),
                 note);
      if (!found[i].first_wrong.empty()) {
        report.wrong_answers.push_back(label + ": first wrong in " + found[i].first_wrong);
      }
    }
    if (subjects[i].arithmetic == Arithmetic::bounded) {
      report.add(label + ": missed, late, wrong V+ or V-", "steps", exactly(all.refuted),
                 at_most(0));
      if (!found[i].first_refuted.empty()) {
        report.wrong_answers.push_back(label + ": missed or late in " + found[i].first_refuted);
      }
    }
    if (subjects[i].arithmetic != Arithmetic::exact) {
      report.add(label + ": right", "%", exactly(percent(all.right, all.cases)), {}, note);
    }
    for (const auto& cell : found[i].cells) {
      report.add_figure("heat", json_of(cell));
      report.add_sample(json_of(cell));
    }
  }
}

// Adds which rung settled the elementary tests and the view tests of one family.
void add_rung_rows(const std::string& label, const FamilyStability& found, BenchReport& report) {
  const auto& r = found.rungs;
  const auto tests = static_cast<double>(r.total());
  const auto share = [&](std::uint64_t n) { return percent(static_cast<double>(n), tests); };
  if (tests > 0) {
    report.add(
        label + ": elementary tests settled by the filter", "%", exactly(share(r.filter)), {},
        fmt::format("of {}; axis {:.1f} %, fixed {:.1f} %, unbounded {:.1f} %, left open {:.1f} %",
                    r.total(), share(r.axis), share(r.fixed), share(r.unbounded), share(r.open)));
  }
  const auto& v = found.view_rungs;
  const auto views = static_cast<double>(v.lanes + v.filter + v.exact + v.open);
  if (views > 0) {
    const auto of_views = [&](std::uint64_t n) { return percent(static_cast<double>(n), views); };
    report.add(label + ": view tests settled by lanes or filter", "%",
               exactly(of_views(v.lanes + v.filter)), {},
               fmt::format("of {}; integers {:.1f} %, left open {:.1f} %", views, of_views(v.exact),
                           of_views(v.open)));
  }
}

// Each family, with what was found in it by each subject.
using AllFound = std::vector<std::pair<std::string, std::vector<FamilyStability>>>;

void add_survival_rows(std::span<const StabilitySubject> subjects, const AllFound& all,
                       BenchReport& report) {
  for (std::size_t k = 0; k < case_changes().size(); ++k) {
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      Survival sum;
      for (const auto& [name, found] : all) {
        sum.changed += found[i].survivals[k].changed;
        sum.same += found[i].survivals[k].same;
      }
      const bool must = subjects[i].arithmetic == Arithmetic::exact;
      const std::string label =
          fmt::format("answers that survive {}, {}", case_changes()[k].name, subjects[i].name);
      report.add(label, "%", exactly(percent(sum.same, sum.changed)),
                 wanted_if(must, at_least(100)),
                 fmt::format("{} of {} changed steps{}", sum.same, sum.changed,
                             must ? ", times included" : ""));
      if (must && sum.same < sum.changed) report.wrong_answers.push_back(label + ": not all");
    }
  }
}

// What is said of all families together.
void add_common_rows(std::span<const StabilitySubject> subjects, const AllFound& all,
                     BenchReport& report) {
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    std::vector<std::string> never_wrong;
    for (const auto& [name, found] : all) {
      if (!found[i].breaks_at()) never_wrong.push_back(name);
    }
    report.add("families in which " + subjects[i].name + " is never wrong", "",
               exactly(static_cast<double>(never_wrong.size())), {},
               fmt::format("of {}: {}", all.size(), fmt::join(never_wrong, ", ")));
  }
  add_survival_rows(subjects, all, report);
  for (const auto& [name, found] : all) {
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      const auto arithmetic = subjects[i].arithmetic;
      if (arithmetic == Arithmetic::exact || arithmetic == Arithmetic::bounded)
        add_rung_rows(name + ", " + subjects[i].name, found[i], report);
    }
  }
}

StabilityPlan plan_for(const corpus::HardFamily& family, const BenchSettings& settings) {
  constexpr int steps_when_small = 4;
  StabilityPlan plan;
  if (settings.scale >= 1) return plan;
  plan.rounds = 1;
  plan.touching_rounds = 2;
  plan.most_triangles = settings.triangles(plan.most_triangles);
  plan.strength_step = std::max(1, family.strongest / steps_when_small);
  return plan;
}

}  // namespace

BenchReport stability_of(std::span<const corpus::HardFamily> families,
                         std::span<const StabilitySubject> subjects, const BenchSettings& settings,
                         const BenchProgress& progress, std::vector<StabilityCell>* cells) {
  BenchReport report("stability");
  AllFound all;
  for (const auto& family : families) {
    progress.phase(std::string(family.name));
    std::vector<std::string> disagreements;
    auto found = measure_stability(family, subjects, plan_for(family, settings), disagreements,
                                   progress.tick);
    for (const auto& id : disagreements) {
      report.wrong_answers.push_back(id +
                                     ": the oracle finds another answer than it was built for");
    }
    for (const auto& of_subject : found) {
      for (const auto& cell : of_subject.cells) {
        if (cells) cells->push_back(cell);
      }
    }
    add_family_rows(family, subjects, found, report);
    all.emplace_back(family.name, std::move(found));
  }
  add_common_rows(subjects, all, report);
  return report;
}

BenchReport stability_suite(const BenchSettings& settings, const BenchProgress& progress) {
  return stability_of(corpus::hard_families(), all_arithmetics(), settings, progress);
}

}  // namespace assay::reports
