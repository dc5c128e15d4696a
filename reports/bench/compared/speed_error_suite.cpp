// Suite `speed-error` measures the cost and the errors of each arithmetic and culling.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reports/bench/compared/comparison.h"

namespace assay::reports {
namespace {

using detector::Arithmetic, detector::Culling, detector::Pairs;

// Returns the title of a table: "26 families (14 scene, 8 generated, 4 real), 971 steps".
std::string families_text(std::span<const FamilyRow> rows, const std::string& reference) {
  std::vector<std::string> list;
  std::uint64_t count = 0, steps = 0;
  for (const std::string kind : {"scene", "generated", "hard", "real"}) {
    const auto before = count;
    for (const auto& row : rows) {
      if (row.subject != reference || row.kind != kind) continue;
      ++count;
      steps += row.steps;
    }
    if (count > before) list.push_back(fmt::format("{} {}", count - before, kind));
  }
  return fmt::format("{} families ({}), {} steps", count, fmt::join(list, ", "), steps);
}

// Adds the errors of each arithmetic, over all cullings and kinds of pairs.
void add_errors(std::span<const SubjectRow> rows, BenchReport& report) {
  for (const auto arithmetic : all_values<Arithmetic>) {
    properties::StepErrors all;
    for (const auto& row : rows) {
      if (row.subject->options.arithmetic == arithmetic) all += row.counts.errors;
    }
    const bool exact = arithmetic == Arithmetic::exact,
               is_proved = exact || arithmetic == Arithmetic::bounded;
    const auto add = [&](const char* label, std::uint64_t count, bool is_claimed,
                         std::string note) {
      report.add(fmt::format("{}, {}", label, name_of(arithmetic)), "",
                 exactly(static_cast<double>(count)), goal_if(is_claimed, at_most(0)),
                 std::move(note));
    };
    const std::string of =
        fmt::format("of {} steps: each --culling, --pairs all and first", all.steps);
    add("wrong answers", all.missed + all.false_alarms, exact, of);
    add("steps with a contact, answered free", all.missed, is_proved, of);
    add("missing pairs", all.missing, is_proved, "");
    add("spurious pairs", all.spurious, exact, "");
    add("first times late", all.late.steps, is_proved, "steps");
    add("first times late or early", all.late.steps + all.early.steps, exact, "steps");
  }
}

// Names the families in which an arithmetic has no wrong answer, no wrong pair and no late time.
void add_families_without_error(std::span<const FamilyRow> rows, BenchReport& report) {
  for (const auto arithmetic :
       {Arithmetic::bounded, Arithmetic::double_precision, Arithmetic::single_precision}) {
    std::set<std::string> right;
    for (const auto& row : rows) right.insert(row.family);
    const auto all = right.size();
    for (const auto& row : rows) {
      const auto& errors = row.counts.errors;
      const bool is_of_it = row.subject.starts_with(std::string(name_of(arithmetic)) + " ");
      if (is_of_it && errors.unsafe + errors.alarming > 0) right.erase(row.family);
    }
    report.add(fmt::format("families in which {} is never wrong", name_of(arithmetic)), "",
               exactly(static_cast<double>(right.size())), {},
               fmt::format("of {}: {}", all, fmt::join(right, ", ")));
  }
}

void add_ratios(std::span<const FamilyRow> rows, BenchReport& report) {
  const auto name = [](Arithmetic arithmetic, Culling culling) {
    return variant_of(arithmetic, culling, Pairs::all).name;
  };
  const auto default_name = name(Arithmetic::exact, Culling::automatic);
  for (const auto& row : rows) {
    if (row.subject != default_name) continue;
    const auto over = [&](const std::string& other) {
      return bootstrap_ratio(row.ms, std::find_if(rows.begin(), rows.end(), [&](const auto& one) {
                                       return one.family == row.family && one.subject == other;
                                     })->ms);
    };
    // Times are judged on large meshes only, because a step of a tiny one is over in some
    // microseconds.
    const bool large = row.kind == "scene" || row.kind == "real";
    const double ns = 1e6 * median_of(row.ms).value / static_cast<double>(row.triangles);
    report.add("auto over bvh, " + row.family, "times", *row.over(),
               goal_if(large, goal::view_auto_over_bvh), fmt::format("{:.0f} ns a triangle", ns));
    report.add("auto over normal-cone, " + row.family, "times",
               over(name(Arithmetic::exact, Culling::normal_cone)));
    report.add("exact over double, auto, " + row.family, "times",
               over(name(Arithmetic::double_precision, Culling::automatic)),
               goal_if(large, goal::exact_over_double));
  }
}

}  // namespace

BenchReport speed_error_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report{"speed-error"};
  std::vector<std::string> missing;
  const auto subjects = all_variants();
  Comparison comparison(subjects, {.sweep = {.is_warm = true}, .jobs = settings.jobs}, report,
                        progress);
  comparison.run(all_families(settings, missing));
  for (const auto& file : missing) report.add_no_data("real sequences", file);
  progress.phase("intervals");
  const auto rows = comparison.subjects();
  add_errors(rows, report);
  add_families_without_error(comparison.rows(), report);
  add_ratios(comparison.rows(), report);
  report.below = fmt::format("\n{}\n{}\n", families_text(comparison.rows(), subjects.front().name),
                             subjects_text(rows, "arithmetic culling pairs"));
  add_figures(rows, comparison, report);
  return report;
}

}  // namespace assay::reports
