// Suite speed-error: its statistics on known numbers, its judgements on steps that floats get
// wrong, its files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "properties/random.h"
#include "reports/bench/bootstrap.h"
#include "reports/bench/speed_error/error_families.h"
#include "reports/bench/speed_error/error_output.h"
#include "reports/bench/speed_error/error_runs.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using detector::Arithmetic;
using detector::Culling;
using detector::Pairs;

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

TEST(Bootstrap, ARateIsOfTheSums) {
  const std::vector<double> steps = {1, 1, 2}, seconds = {1, 1, 98};
  const auto rate = bootstrap_ratio_of_sums(steps, seconds);
  EXPECT_DOUBLE_EQ(rate.value, 0.04);  // not the median of 1, 1 and 0.02
  EXPECT_NEAR(rate.lo, 2. / 98, 1e-12);
  EXPECT_EQ(rate.hi, 1);
}

TEST(FirstTimeError, CountsDoublesBetween) {
  const double t = 0.375, after = std::nextafter(t, 1);
  EXPECT_EQ(first_time_error({t, t}, {t, after}).late_ulps, 0);
  EXPECT_EQ(first_time_error({t, t}, {t, after}).early_ulps, 0);
  EXPECT_EQ(first_time_error({after, after}, {t, after}).late_ulps, 1);
  const auto early = first_time_error({t - 0.125, t}, {t, t});
  EXPECT_EQ(early.early_share, 0.125);
  EXPECT_EQ(early.early_ulps, 0x1p51);  // a half of the doubles from 1/4 to 1/2
  EXPECT_EQ(first_time_error({-0.0, 0}, {0, 0}).early_ulps, 0);
  EXPECT_EQ(first_time_error({1, 1}, {0.5, 0.5}).late_share, 0.5);
}

TEST(Variants, EveryArithmeticCullingAndKindOfPairs) {
  EXPECT_EQ(all_variants(false).size(), 4u * 6u * 2u);
  EXPECT_EQ(all_variants(true).size(), 4u * 7u * 2u);
  EXPECT_EQ(all_variants(false).front(), reference_variant);
  EXPECT_EQ(name_of(reference_variant), "exact bvh all");
}

JudgedStep judged(const std::string& family, Variant variant, double ns) {
  JudgedStep step;
  step.family = family;
  step.kind = "scene";
  step.variant = variant;
  step.triangles = 10;
  step.ns = {ns, 2 * ns, 3 * ns};
  step.reference_ns = {100, 200, 300};
  step.contact = true;
  return step;
}

TEST(ErrorSummary, TimesErrorsAndParetoLine) {
  const Variant doubles{Arithmetic::double_precision, Culling::bvh, Pairs::all},
      floats{Arithmetic::single_precision, Culling::bvh, Pairs::all};
  std::vector<JudgedStep> steps;
  for (const std::string family : {"a", "b"}) {
    for (int s = 0; s < 2; ++s) {
      steps.push_back(judged(family, reference_variant, 100));
      steps.push_back(judged(family, doubles, 50));
      steps.push_back(judged(family, floats, 60));
    }
  }
  steps[1].missing = 2;                                   // doubles: one unsafe step
  steps[4].first = {.late_ulps = 3, .late_share = 0.25};  // and a late one
  steps[2].false_alarm = true;                            // floats: an alarming one
  steps[5].missed = true;                                 // three unsafe ones
  steps[8].spurious = 4;
  steps[8].missed = true;
  steps[11].missed = true;
  const auto families = by_family(steps);
  ASSERT_EQ(families.size(), 6u);
  EXPECT_EQ(families_text(families), "2 families (2 scene), 4 steps");
  EXPECT_EQ(families[0].variant, reference_variant);
  EXPECT_EQ(families[1].over_reference.value, 0.5);
  EXPECT_EQ(families[1].ns_a_step.value, 100);
  EXPECT_EQ(families[1].ns_a_triangle.value, 10);
  EXPECT_EQ(families[1].errors.unsafe, 2u);
  EXPECT_EQ(families[1].errors.missing, 2u);
  EXPECT_EQ(families[1].errors.late.steps, 1u);
  EXPECT_EQ(families[1].errors.late.largest_ulps, 3);
  EXPECT_EQ(time_over(families, "b", floats, doubles).value, 1.2);
  const auto variants = by_variant(steps, families);
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
  const auto csv = csv_of(std::span(steps));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 12);
  EXPECT_NE(csv.find("double,bvh,all,0000000000000000,0,0,0,1,1,0,0,2,0,0,0,0,0,50 100 150\n"),
            std::string::npos)
      << csv;
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
  const auto families = error_families({"/nowhere", 0.1}, missing);
  EXPECT_EQ(missing.size(), 4u);
  std::vector<JudgedStep> steps;
  for (const auto& family : families) {
    if (family.name != "closed-near-degenerate") continue;
    for (const auto& timed : family.cases()) {
      const auto done = run_case(family, timed, wrong, [] {});
      steps.insert(steps.end(), done.begin(), done.end());
    }
  }
  EXPECT_TRUE(wrong.empty()) << wrong.front();
  const auto count = [&](Arithmetic arithmetic, bool (JudgedStep::*is)() const) {
    return std::count_if(steps.begin(), steps.end(), [&](const JudgedStep& s) {
      return s.variant.arithmetic == arithmetic && (s.*is)();
    });
  };
  EXPECT_EQ(count(Arithmetic::exact, &JudgedStep::unsafe), 0);
  EXPECT_EQ(count(Arithmetic::exact, &JudgedStep::alarming), 0);
  EXPECT_EQ(count(Arithmetic::bounded, &JudgedStep::unsafe), 0);
  EXPECT_GT(count(Arithmetic::single_precision, &JudgedStep::unsafe), 0);
  EXPECT_GT(count(Arithmetic::single_precision, &JudgedStep::alarming), 0);
  EXPECT_GT(count(Arithmetic::double_precision, &JudgedStep::unsafe), 0);
}

TEST(SpeedErrorSuite, EveryFamilyAndVariant) {
  Progress progress("bench");
  const BenchReport report = speed_error_suite({"/nowhere", 0.01}, progress);
  EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
  EXPECT_EQ(report.variants.size(), all_variants(true).size());
  for (const auto& row : report.rows) {
    EXPECT_TRUE(!row.measured || std::isfinite(row.measured->value)) << row.label;
    if (row.label == "wrong answers, exact") {
      EXPECT_EQ(row.outcome(), RowOutcome::holds);
    }
  }
  const auto json = to_json(report);
  EXPECT_EQ(json["families"].size(), report.families.size());
  EXPECT_EQ(json["families"][0]["time_over_reference"]["samples"].size(), 2u);
  EXPECT_EQ(json["variants"][0]["errors"]["unsafe"], 0);
  EXPECT_NE(text_of(report).find("double     view-auto   all"), std::string::npos);
}

}  // namespace
}  // namespace assay::reports
