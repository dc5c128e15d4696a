// `assay bench`: its statistics on known numbers, its suites at a hundredth of their size, and the
// verb on the command line.
#include "reports/bench/compared/comparison.h"
#include "tests/reports/program.h"

namespace assay::reports {
namespace {

std::vector<double> one_to(int n) {
  std::vector<double> x(static_cast<std::size_t>(n));
  std::iota(x.begin(), x.end(), 1);
  return x;
}

TEST(Estimate, MedianAndItsRankInterval) {
  EXPECT_EQ(median_of({3, 1, 2}).value, 2);
  EXPECT_EQ(median_of({4, 1, 3, 2}).value, 2.5);
  // Ranks of the table of the sign test at 95 %: n, k.
  const std::pair<std::size_t, std::size_t> table[] = {
      {5, 1}, {6, 1}, {8, 1}, {9, 2}, {11, 2}, {12, 3}, {15, 4}, {20, 6}, {25, 8}, {50, 18}};
  for (const auto& [n, k] : table) EXPECT_EQ(rank_of_lower_end(n), k) << n;
  const Estimate estimate = median_of(one_to(20));
  EXPECT_EQ(estimate.value, 10.5);
  EXPECT_EQ(estimate.lo, 6);
  EXPECT_EQ(estimate.hi, 15);
}

TEST(Estimate, RatiosAreTakenRoundByRound) {
  // Every round is slower than the one before; the ratio in each is 2.
  const std::vector<double> a = {2, 20, 200}, b = {1, 10, 100};
  EXPECT_EQ(ratio_of(a, b).value, 2);
  for (const Estimate& ratio : {ratio_of(a, b), bootstrap_ratio(a, b)}) {
    EXPECT_EQ(ratio.lo, 2);
    EXPECT_EQ(ratio.hi, 2);
  }
  EXPECT_EQ(scaled(exactly(3), 2).samples[0], 6);
}

TEST(Estimate, QuantilesAreNearestRank) {
  EXPECT_EQ(quantile(one_to(1000), 0.999), 999);
  EXPECT_EQ(quantile(one_to(1000), 1), 1000);
  EXPECT_EQ(quantile(one_to(10), 0.5), 5);
  EXPECT_EQ(quantile({7}, 0.999), 7);
}

TEST(Sweep, RoundsRunForwardAndBackward) {
  std::string order;
  const auto subject = [&](char name) {
    return SweptSubject{nullptr, {}, [&order, name](const detector::Options& options) {
                          order += name;
                          return detector::standard_stages(options);
                        }};
  };
  const auto timed = timed_case("", bench_scene("bend", 320, 3), detector::Start::verified);
  const SweptSubject subjects[] = {subject('a'), subject('b')};
  const auto runs = sweep(timed.c, subjects, {.rounds = 2});
  EXPECT_EQ(order,
            "ab"
            "ab"
            "ba");  // the first is judged
  for (const auto& of_subject : runs) {
    EXPECT_EQ(of_subject.samples.size(), 2u);
    EXPECT_EQ(of_subject.of_step(1).size(), 2u);
    EXPECT_FALSE(of_subject.has_differing_runs);
  }
}

TEST(BenchRow, OutcomeIsThatOfTheMedian) {
  BenchReport report;
  report.add("a", "ns", exactly(2), at_most(2));
  report.add("b", "ns", exactly(2), at_most(1.5));
  report.add("c", "ns", exactly(2), at_least(3));
  report.add("d", "ns", exactly(2));
  report.add_no_data("e", "nowhere");
  const char* wanted[] = {"holds", "fails", "fails", "-", "no data"};
  for (std::size_t i = 0; i < report.rows.size(); ++i)
    EXPECT_STREQ(report.rows[i].outcome(), wanted[i]);
  EXPECT_TRUE(says(text_of(report), "nowhere is not there"));
}

TEST(BenchReport, TablesHaveTheirColumns) {
  const std::vector<Column> row = {{"a", -5, "ab"}, {"bcdef", 4, "12"}, {"", 0, "end "}};
  EXPECT_EQ(table_text({row}), "a     bcdef\nab      12 end \n");
  EXPECT_EQ(table_text({row, row}, 0), "a    bcdef\nab     12end \nab     12end \n");
  EXPECT_EQ(table_text({}), "");
}

// A field that is an object has a column for each of its fields, and a line that lacks one has an
// empty field there.
TEST(BenchReport, SamplesAreLinesOfFields) {
  BenchReport report{"some"};
  report.add("a, b", "us", median_of({2, 1}));
  EXPECT_EQ(csv_of(report),
            "suite,what,unit,sample,value\nsome,\"a, b\",\"us\",1,2\n"
            "some,\"a, b\",\"us\",2,1\n");
  report.add_sample(json_object("name", "x, y", "over", std::optional<double>(), "ns",
                                std::vector<double>{1, 2.5}));
  report.add_sample(json_object("name", "z", "over", json_object("value", 3, "is_slow", true), "ns",
                                std::vector<double>{4}));
  EXPECT_EQ(csv_of(report), "name,ns,over_value,over_is_slow\n\"x, y\",1 2.5,,\nz,4,3,1\n");
}

TEST(Suites, Sequences) {
  const BenchReport report = sequences_suite({"/nowhere", 0.01}, {});
  EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
  const auto json = to_json(report, "version");
  EXPECT_EQ(json["schema"], "assay-bench/2");
  EXPECT_EQ(json["rows"].size(), report.rows.size());
  std::string labels;
  for (const auto& row : report.rows) {
    EXPECT_TRUE(!row.estimate || std::isfinite(row.estimate->value)) << row.label;
    labels += "\n" + row.label;
  }
  for (const char* row : {"\nbend, view-line, 1 thread: time over the time of bvh",
                          "\ntwist, auto over the best single culling, sum",
                          "\nopen-tube, auto over the best single culling, median step",
                          "\narm-in-box, auto over bvh, first step"})
    EXPECT_TRUE(says(labels, row));
}

}  // namespace
}  // namespace assay::reports
