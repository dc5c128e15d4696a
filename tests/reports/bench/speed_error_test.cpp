// Suite speed-error: its statistics on known numbers, its judgements on steps that floats get
// wrong, its files.
#include "reports/bench/whole/speed_error.h"

#include <nlohmann/json.hpp>

#include "properties/random.h"
#include "reports/bench/cases.h"
#include "reports/estimate.h"
#include "tests/reports/json_schema.h"
#include "tests/test.h"

namespace assay::reports {
namespace {

using detector::Arithmetic, detector::Culling, detector::Pairs;

TEST(Bootstrap, IsDeterministicAndHoldsTheMedian) {
  const std::vector<double> samples = {5, 1, 4, 2, 3, 9, 7};
  const auto a = bootstrap_median(samples), b = bootstrap_median(samples);
  EXPECT_EQ(a.value, 4);
  EXPECT_EQ(a.samples, samples);
  EXPECT_EQ(a.lo, b.lo);
  EXPECT_EQ(a.hi, b.hi);
  EXPECT_LT(a.lo, 4);
  EXPECT_GT(a.hi, 4);
  EXPECT_EQ(bootstrap_median({2, 2, 2}).hi, 2);
  EXPECT_EQ(bootstrap_median({1, 2, 3, 4}).value, 2.5);
}

TEST(Bootstrap, CoversTheTrueMedianAboutAsOftenAsItSays) {
  properties::Random random("bootstrap coverage");
  int covered = 0;
  constexpr int trials = 400;
  for (int t = 0; t < trials; ++t) {
    std::vector<double> samples;
    for (int i = 0; i < 41; ++i) samples.push_back(random.unit());
    const auto estimate = bootstrap_median(std::move(samples));
    covered += estimate.lo <= 0.5 && 0.5 <= estimate.hi;
  }
  EXPECT_GT(covered, 0.90 * trials);
  EXPECT_LT(covered, 0.99 * trials);  // an interval that is too wide says nothing
}

TEST(Bootstrap, RatiosAreTakenRoundByRound) {
  const std::vector<double> a = {2, 20, 200}, b = {1, 10, 100};
  EXPECT_EQ(bootstrap_ratio(a, b).lo, 2);
  EXPECT_EQ(bootstrap_ratio(a, b).hi, 2);
}

TEST(Variants, EveryArithmeticCullingAndKindOfPairs) {
  EXPECT_EQ(all_variants(false).size(), 4u * 6u * 2u);
  EXPECT_EQ(all_variants(true).size(), 4u * 7u * 2u);
  EXPECT_EQ(all_variants(false).front(), reference_variant);
  EXPECT_EQ(name_of(reference_variant), "exact bvh all");
}

// A step that is judged, with these errors beside its contact.
VariantStep judged(const std::string& family, Variant variant, double ns,
                   properties::StepErrors errors = {}) {
  VariantStep step;
  step.family = family;
  step.kind = "scene";
  step.variant = variant;
  step.triangles = 10;
  step.ns = {ns, 2 * ns, 3 * ns};
  step.reference_ns = {100, 200, 300};
  step.errors = errors;
  step.errors.steps = step.errors.contact = 1;
  return step;
}

TEST(ErrorSummary, TimesErrorsAndParetoLine) {
  const Variant doubles{Arithmetic::double_precision, Culling::bvh, Pairs::all},
      floats{Arithmetic::single_precision, Culling::bvh, Pairs::all};
  properties::StepErrors right, missed, alarm, missing, late, both;
  missed.missed = missed.unsafe = 1;
  alarm.false_alarms = alarm.alarming = 1;
  missing.missing = 2;
  missing.unsafe = late.unsafe = 1;
  late.late = {1, 0.25, 3, {{0.25, 1}}};
  both = missed;
  both.alarming = 1;
  both.spurious = 4;
  std::vector<VariantStep> steps;
  // Two steps of each family. Doubles: two unsafe steps of the first. Floats: three unsafe ones,
  // and two alarming ones.
  const properties::StepErrors of_doubles[] = {missing, late, right, right},
                               of_floats[] = {alarm, missed, both, missed};
  for (std::size_t s = 0; s < 4; ++s) {
    const std::string family = s < 2 ? "a" : "b";
    steps.push_back(judged(family, reference_variant, 100));
    steps.push_back(judged(family, doubles, 50, of_doubles[s]));
    steps.push_back(judged(family, floats, 60, of_floats[s]));
  }
  const auto families = by_family(steps);
  ASSERT_EQ(families.size(), 6u);
  EXPECT_EQ(families[0].variant, reference_variant);
  EXPECT_EQ(families[1].over_reference.value, 0.5);
  EXPECT_EQ(families[1].ns_a_step.value, 100);
  EXPECT_EQ(families[1].ns_a_triangle.value, 10);
  EXPECT_EQ(families[1].errors.unsafe, 2u);
  EXPECT_EQ(families[1].errors.missing, 2u);
  EXPECT_EQ(families[1].errors.late.steps, 1u);
  EXPECT_EQ(families[1].errors.late.worst_ulps, 3);
  EXPECT_EQ(time_over(families, "b", floats, doubles).value, 1.2);
  const auto variants = by_variant(families);
  ASSERT_EQ(variants.size(), 3u);
  EXPECT_EQ(variants[1].unsafe.share, 0.5);
  EXPECT_LT(variants[1].unsafe.lo, 0.1);  // two of four say little
  EXPECT_GT(variants[1].unsafe.hi, 0.9);
  EXPECT_EQ(variants[0].unsafe.lo, 0);
  EXPECT_NEAR(variants[0].unsafe.hi, 1 - std::pow(0.025, 0.25), 1e-9);
  // Floats are slower than doubles and worse in both.
  EXPECT_TRUE(variants[0].unsafe.on_pareto_line);
  EXPECT_TRUE(variants[1].unsafe.on_pareto_line);
  EXPECT_FALSE(variants[2].unsafe.on_pareto_line);
  EXPECT_FALSE(variants[0].alarming.on_pareto_line);  // doubles are faster, and as right in that
  BenchReport report("speed-error");
  add_figures(steps, families, variants, report);
  EXPECT_NE(report.below.find("2 families (2 scene), 4 steps\n"), std::string::npos);
  const auto csv = csv_of(report);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 12);
  EXPECT_TRUE(csv.starts_with("family,kind,case,step,triangles,arithmetic,culling,pairs,hash,"))
      << csv;
  EXPECT_NE(csv.find("double,bvh,all,0000000000000000,0,0,0,1,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",50 100 150\n"), std::string::npos) << csv;
}

TEST(AroundFirstContact, EndsSoonAfterIt) {
  const auto scene = bench_scene("dented-sphere", 320, 11);
  const auto part = around_first_contact(scene);
  EXPECT_EQ(part.frames.size(), 6u);
  EXPECT_GT((part.frames[0] - scene.frames[0]).norm(), 0);  // not from the beginning
  const auto free = bench_scene("breathing-sphere", 320, 11);
  EXPECT_EQ(around_first_contact(free).frames[0], free.frames[0]);
}

// Small cases on which floats are wrong, and doubles a little: the judge must see it.
TEST(ErrorRuns, FloatsAreWrongAndExactIsNot) {
  std::vector<std::string> missing, wrong;
  const auto families = all_families({"/nowhere", 0.1}, missing);
  EXPECT_EQ(missing.size(), 4u);
  std::vector<VariantStep> steps;
  for (const auto& family : families) {
    if (family.name != "closed-near-degenerate") continue;
    for (const auto& timed : family.cases()) {
      const auto done = run_case(family, timed, wrong, [] {});
      steps.insert(steps.end(), done.begin(), done.end());
    }
  }
  EXPECT_TRUE(wrong.empty()) << wrong.front();
  using properties::StepErrors;
  const auto count = [&](Arithmetic arithmetic, std::uint64_t StepErrors::*member) {
    std::uint64_t sum = 0;
    for (const auto& s : steps) sum += s.variant.arithmetic == arithmetic ? s.errors.*member : 0;
    return sum;
  };
  EXPECT_EQ(count(Arithmetic::exact, &StepErrors::unsafe), 0u);
  EXPECT_EQ(count(Arithmetic::exact, &StepErrors::alarming), 0u);
  EXPECT_EQ(count(Arithmetic::bounded, &StepErrors::unsafe), 0u);
  EXPECT_GT(count(Arithmetic::single_precision, &StepErrors::unsafe), 0u);
  EXPECT_GT(count(Arithmetic::single_precision, &StepErrors::alarming), 0u);
  EXPECT_GT(count(Arithmetic::double_precision, &StepErrors::unsafe), 0u);
}

TEST(SpeedErrorSuite, EveryFamilyAndVariant) {
  const BenchReport report = speed_error_suite({"/nowhere", 0.01}, {});
  EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
  EXPECT_EQ(report.figures.at("variants").size(), all_variants(true).size());
  for (const auto& row : report.rows) {
    EXPECT_TRUE(!row.measured || std::isfinite(row.measured->value)) << row.label;
    if (row.label == "wrong answers, exact") {
      EXPECT_EQ(row.outcome(), RowOutcome::holds);
    }
  }
  const auto json = to_json(report, "version");
  tests::expect_schema("bench", json);
  EXPECT_EQ(json["families"].size(), report.figures.at("families").size());
  EXPECT_EQ(json["families"][0]["time_over_reference"]["samples"].size(), 2u);
  EXPECT_EQ(json["variants"][0]["errors"]["unsafe"], 0);
  EXPECT_NE(text_of(report).find("double     view-auto   all"), std::string::npos);
}

}  // namespace
}  // namespace assay::reports
