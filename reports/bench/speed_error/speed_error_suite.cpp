// Suite `speed-error` measures what each arithmetic and culling costs, and what it gets wrong.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "properties/judging/case_check.h"
#include "reports/bench/speed_error/error_output.h"
#include "reports/bench/speed_error/error_runs.h"
#include "reports/terminal/words.h"

namespace assay::reports {
namespace {

using namespace detector;

std::size_t time_errors(const ErrorCounts& errors) {
  return errors.late.steps + errors.early.steps;
}

// Adds what each arithmetic gets wrong, over all cullings and kinds of pairs.
void add_errors(std::span<const VariantSummary> variants, BenchReport& report) {
  for (const auto arithmetic : every_arithmetic) {
    std::size_t judged = 0, answers = 0, missing = 0, spurious = 0, times = 0, missed = 0, late = 0;
    for (const auto& [variant, over_reference, errors, unsafe, alarming] : variants) {
      if (variant.arithmetic != arithmetic) continue;
      judged += errors.judged;
      missed += errors.missed;
      answers += errors.missed + errors.false_alarms;
      missing += errors.missing;
      spurious += errors.spurious;
      times += time_errors(errors);
      late += errors.late.steps;
    }
    const bool exact = arithmetic == Arithmetic::exact,
               proved = exact || arithmetic == Arithmetic::bounded;
    const auto add = [&](const char* label, std::size_t count, bool claimed, std::string note) {
      report.add(fmt::format("{}, {}", label, properties::name_of(arithmetic)), "",
                 exactly(static_cast<double>(count)), wanted_if(claimed, at_most(0)),
                 std::move(note));
    };
    const std::string of = fmt::format("of {} steps, all cullings, all pairs and first", judged);
    add("wrong answers", answers, exact, of);
    add("free against a contact", missed, proved, of);
    add("missing pairs", missing, proved, "");
    add("spurious pairs", spurious, exact, "");
    add("first times late", late, proved, "steps");
    add("first times late or early", times, exact, "steps");
  }
}

// Names the families in which an arithmetic has no wrong answer, no wrong pair and no late time.
void add_families_without_error(std::span<const FamilySummary> families, BenchReport& report) {
  for (const auto arithmetic :
       {Arithmetic::bounded, Arithmetic::double_precision, Arithmetic::single_precision}) {
    std::set<std::string> all, wrong;
    for (const auto& family : families) {
      all.insert(family.family);
      if (family.variant.arithmetic == arithmetic &&
          family.errors.unsafe + family.errors.alarming > 0) {
        wrong.insert(family.family);
      }
    }
    std::set<std::string> right;
    std::set_difference(all.begin(), all.end(), wrong.begin(), wrong.end(),
                        std::inserter(right, right.end()));
    report.add(fmt::format("families never wrong, {}", properties::name_of(arithmetic)), "",
               exactly(static_cast<double>(right.size())), {},
               fmt::format("of {}: {}", all.size(), joined(right, ", ")));
  }
}

void add_ratios(std::span<const FamilySummary> families, BenchReport& report) {
  const Variant chosen{Arithmetic::exact, Culling::automatic, Pairs::all};
  const Variant cones{Arithmetic::exact, Culling::normal_cone, Pairs::all};
  const Variant doubles{Arithmetic::double_precision, Culling::automatic, Pairs::all};
  for (const auto& family : families) {
    if (family.variant != chosen) continue;
    const std::string& name = family.family;
    // Times are judged on large meshes only, because a step of a tiny one is over in some
    // microseconds.
    const bool large = family.kind == "scene" || family.kind == "real";
    const std::string note = fmt::format("{:.0f} ns a triangle", family.ns_a_triangle.value);
    report.add("auto over bvh, " + name, "times", family.over_reference,
               wanted_if(large, wanted::view_auto_over_bvh), note);
    report.add("auto over normal-cone, " + name, "times", time_over(families, name, chosen, cones));
    report.add("exact over double, auto, " + name, "times",
               time_over(families, name, chosen, doubles),
               wanted_if(large, wanted::exact_over_double));
  }
}

}  // namespace

BenchReport speed_error_suite(const BenchSettings& settings, Progress& progress) {
  BenchReport report("speed-error");
  std::vector<std::string> missing;
  std::vector<JudgedStep> steps;
  for (const auto& family : error_families(settings, missing)) {
    progress.phase(family.name);
    for (const auto& timed : family.cases()) {
      auto done = run_case(family, timed, report.wrong_answers, [&] { progress.tick(); });
      std::move(done.begin(), done.end(), std::back_inserter(steps));
    }
  }
  for (const auto& file : missing) report.add_no_data("real sequences", file);
  progress.phase("intervals");
  const auto families = by_family(steps);
  const auto variants = by_variant(steps, families);
  add_errors(variants, report);
  add_families_without_error(families, report);
  add_ratios(families, report);
  report.variants = variants;
  report.families = families;
  report.steps = std::move(steps);
  return report;
}

}  // namespace assay::reports
