// Suite `speed-error`: its statistics on known numbers, its judgements of steps on which floats are
// wrong, and its files.

#include "properties/random.h"
#include "reports/bench/compared/comparison.h"
#include "reports/bench/sweep.h"
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

TEST(Variants, EveryArithmeticCullingAndKindOfPairs) {
  const auto variants = all_variants();
  EXPECT_EQ(variants.size(), 4u * 7u * 2u);
  EXPECT_EQ(variants.front().name, "exact bvh all");
}

TEST(ErrorSummary, TimesErrorsAndParetoLine) {
  const std::vector subjects = {variant_of(Arithmetic::exact, Culling::bvh, Pairs::all),
                                variant_of(Arithmetic::double_precision, Culling::bvh, Pairs::all),
                                variant_of(Arithmetic::single_precision, Culling::bvh, Pairs::all)};
  // Two families of two steps. Doubles: two unsafe steps of the first. Floats: three unsafe ones,
  // and two alarming ones.
  const std::uint64_t unsafe[2][3] = {{0, 2, 1}, {0, 0, 2}},
                      alarming[2][3] = {{0, 0, 1}, {0, 0, 1}};
  std::vector<FamilyRow> families;
  for (std::size_t f = 0; f < 2; ++f) {
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      FamilyRow row{subjects[i].name, f == 0 ? "a" : "b", "scene"};
      const double ms[] = {100, 50, 60};
      row.ms = {ms[i], 2 * ms[i], 3 * ms[i]};
      row.reference_ms = {100, 200, 300};
      row.create_ms = row.reference_create_ms = {1, 1, 1};
      row.cases = row.cases_timed = 1;
      row.steps = row.steps_timed = 2;
      row.counts.errors.steps = 2;
      row.counts.errors.unsafe = unsafe[f][i];
      row.counts.errors.alarming = alarming[f][i];
      families.push_back(row);
    }
  }
  EXPECT_EQ(families[1].over()->value, 0.5);
  const auto rows = by_subject(families, subjects);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].over->value, 0.5);
  EXPECT_EQ(rows[1].unsafe.share, 0.5);
  EXPECT_LT(rows[1].unsafe.lo, 0.1);  // two of four say little
  EXPECT_GT(rows[1].unsafe.hi, 0.9);
  EXPECT_EQ(rows[0].unsafe.lo, 0);
  EXPECT_NEAR(rows[0].unsafe.hi, 1 - std::pow(0.025, 0.25), 1e-9);
  // Floats are slower than doubles and worse in both.
  EXPECT_TRUE(rows[0].unsafe.on_pareto_line);
  EXPECT_TRUE(rows[1].unsafe.on_pareto_line);
  EXPECT_FALSE(rows[2].unsafe.on_pareto_line);
  EXPECT_FALSE(rows[0].alarming.on_pareto_line);  // doubles are faster, and as right in that
  EXPECT_TRUE(says(subjects_text(rows, "variant"), "double bvh all"));
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
  std::vector<std::string> missing;
  const auto families = all_families({"/nowhere", 0.1}, missing);
  EXPECT_EQ(missing.size(), 4u);
  const auto variants = all_variants();
  BenchReport report{"some"};
  Comparison comparison(variants, {}, report);
  for (const auto& family : families) {
    if (family.name == "closed-near-degenerate") comparison.run({family});
  }
  EXPECT_TRUE(report.wrong_answers.empty()) << report.wrong_answers.front();
  using properties::StepErrors;
  const auto count = [&](const std::string& arithmetic, std::uint64_t StepErrors::*member) {
    std::uint64_t sum = 0;
    for (const auto& row : comparison.rows())
      sum += row.subject.starts_with(arithmetic) ? row.counts.errors.*member : 0;
    return sum;
  };
  EXPECT_EQ(count("exact ", &StepErrors::unsafe), 0u);
  EXPECT_EQ(count("exact ", &StepErrors::alarming), 0u);
  EXPECT_EQ(count("bounded ", &StepErrors::unsafe), 0u);
  EXPECT_GT(count("float ", &StepErrors::unsafe), 0u);
  EXPECT_GT(count("float ", &StepErrors::alarming), 0u);
  EXPECT_GT(count("double ", &StepErrors::unsafe), 0u);
  // A line for each step and subject, with the times of all rounds.
  const auto csv = csv_of(report);
  EXPECT_TRUE(csv.starts_with("family,kind,case,step,triangles,subject,hash,box_tests,")) << csv;
  EXPECT_TRUE(says(csv, "float bvh all"));
}

TEST(SpeedErrorSuite, EveryFamilyAndVariant) {
  const BenchReport report = speed_error_suite({"/nowhere", 0.01}, {});
  EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
  EXPECT_EQ(report.figures.at("subjects").size(), all_variants().size());
  for (const auto& row : report.rows) {
    EXPECT_TRUE(!row.estimate || std::isfinite(row.estimate->value)) << row.label;
    EXPECT_TRUE(row.label != "wrong answers, exact" || row.outcome() == std::string("holds"));
  }
  const auto json = to_json(report, "version");
  tests::expect_schema("bench", json);
  EXPECT_EQ(json["families"].size(), report.figures.at("families").size());
  EXPECT_EQ(json["families"][0]["time_over_reference"]["samples"].size(), 2u);
  EXPECT_EQ(json["subjects"][0]["counts"]["unsafe"], 0);
  EXPECT_TRUE(says(text_of(report), "double view-auto all"));
}

}  // namespace
}  // namespace assay::reports
