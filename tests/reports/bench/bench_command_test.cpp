// `assay bench`: its statistics on known numbers, its suites at a hundredth of their size, and the
// verb as a user runs it.
#include "corpus/scenes/scenes.h"
#include "detector/contact/elementary.h"
#include "detector/step/stages.h"
#include "reports/bench/cases.h"
#include "reports/bench/interleave.h"
#include "reports/bench/parts/measuring_arena.h"
#include "reports/bench/pictures.h"
#include "reports/bench/query_sets.h"
#include "reports/bench/sweep.h"
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
  EXPECT_EQ(ratio_of(a, b).lo, 2);
  EXPECT_EQ(ratio_of(a, b).hi, 2);
  EXPECT_EQ(scaled(exactly(3), 2).samples[0], 6);
}

TEST(Estimate, QuantilesAreNearestRank) {
  EXPECT_EQ(quantile(one_to(1000), 0.999), 999);
  EXPECT_EQ(quantile(one_to(1000), 1), 1000);
  EXPECT_EQ(quantile(one_to(10), 0.5), 5);
  EXPECT_EQ(quantile({7}, 0.999), 7);
}

TEST(Estimate, LinesAndExponents) {
  const std::vector<double> x = {1, 2, 3}, y = {5, 7, 9};
  EXPECT_DOUBLE_EQ(fit_line(x, y).slope, 2);
  EXPECT_DOUBLE_EQ(fit_line(x, y).intercept, 3);
  const std::vector<double> n = {1e3, 1e4, 1e5};
  std::vector<double> squares;
  for (const double s : n) squares.push_back(7 * s * s);
  EXPECT_NEAR(growth_exponent(n, squares), 2, 1e-12);
}

TEST(Interleave, RoundsRunForwardAndBackward) {
  std::string order;
  const auto samples = interleave(2, {[&] {
                                        order += 'a';
                                        return 1.;
                                      },
                                      [&] {
                                        order += 'b';
                                        return 2.;
                                      }});
  EXPECT_EQ(order,
            "ab"
            "ab"
            "ba");  // the first is thrown away
  EXPECT_EQ(samples[0], std::vector<double>(2, 1.));
  EXPECT_EQ(samples[1], std::vector<double>(2, 2.));
}

TEST(BenchRow, OutcomeIsThatOfTheMedian) {
  BenchReport report;
  report.add("a", "ns", exactly(2), at_most(2));
  report.add("b", "ns", exactly(2), below(2));
  report.add("c", "ns", exactly(2), at_least(3));
  report.add("d", "ns", exactly(2));
  report.add_no_data("e", "nowhere");
  const char* wanted[] = {"holds", "fails", "fails", "-", "no data"};
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    EXPECT_STREQ(name_of(report.rows[i].outcome()), wanted[i]);
  }
  EXPECT_NE(text_of(report).find("nowhere is not there"), std::string::npos);
}

TEST(BenchReport, TablesHaveTheirColumns) {
  const int widths[] = {-5, 4, -1};
  EXPECT_EQ(table_line(widths, {"ab", "12", "end"}), "ab      12 end\n");
  EXPECT_EQ(table_line(widths, {"ab", "12", "end"}, 0), "ab     12end\n");
}

// A field that is an object has a column for each of its fields, and a line that lacks one has an
// empty field there.
TEST(BenchReport, SamplesAreLinesOfFields) {
  BenchReport report("some");
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

TEST(BreakEven, LineAndLastCrossing) {
  // log(ratio) = 1 - 2 share crosses 0 at a half.
  std::vector<ScatterPoint> points;
  for (const double share : {0., 0.2, 0.4, 0.6, 1.}) {
    points.push_back({"s", "view-point", share, std::exp(1 - 2 * share)});
  }
  const BreakEven found = break_even(points);
  ASSERT_TRUE(found.by_fit);
  EXPECT_NEAR(*found.by_fit, 0.5, 1e-12);
  EXPECT_EQ(found.last_crossing, 0.4);
  for (auto& p : points) p.ratio = 0.5 - 0.1 * p.share;
  EXPECT_FALSE(break_even(points).by_fit);
  EXPECT_EQ(break_even(points).last_crossing, 0);
}

TEST(PeakMemory, OfAnArray) {
  constexpr std::size_t bytes = 64u << 20;
  const auto peak = peak_memory_of([] { keep(std::vector<char>(bytes, 1)); });
  if (!peak) GTEST_SKIP() << "no /proc/self/clear_refs here";
  EXPECT_GT(*peak, 0.98 * bytes);
  EXPECT_LT(*peak, 1.1 * bytes);
}

TEST(SweptBoxes, HoldTheTrianglesAtBothEnds) {
  const auto scene = bench_scene("breathing-sphere", 320, 3);
  const auto &x0 = scene.frames[0], &x1 = scene.frames[1];
  const auto mesh = detector::make_topology(scene.triangles, x0.rows());
  std::vector<SweptBox> boxes(mesh.triangles.size());
  write_swept_boxes(mesh, x0, x1, boxes);
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      double least = 1e300, largest = -1e300;
      for (const auto v : mesh.triangles[t]) {
        least = std::min({least, x0(v, k), x1(v, k)});
        largest = std::max({largest, x0(v, k), x1(v, k)});
      }
      EXPECT_EQ(boxes[t][static_cast<std::size_t>(k)], least);
      EXPECT_EQ(boxes[t][static_cast<std::size_t>(k) + 3], largest);
    }
  }
}

TEST(MeshCandidates, HoldEveryContactOfTheStep) {
  const auto step = step_at_first_contact("dented-sphere", 1'280);
  ASSERT_TRUE(step);
  const auto candidates = mesh_candidates(*step, 1u << 20);
  EXPECT_EQ(candidates.queries.size(), candidates.all);
  const auto first = [&] {
    double least = 2;
    for (const auto& q : candidates.queries) {
      const auto result = detector::test_contact(q, detector::Want::first_time);
      if (result.contact) least = std::min(least, result.time.lo);
    }
    return least;
  }();
  BenchReport report;
  TimedStep bvh("dent", step->triangles, step->frames, bench_options(detector::Culling::bvh),
                report);
  ASSERT_EQ(bvh.result().answer, detector::Answer::collision);
  EXPECT_EQ(first, bvh.result().first.lo);
}

TEST(TimedStep, AResultThatChangesIsAWrongAnswer) {
  // An elementary test that finds nothing from its second step on.
  class Forgetful : public detector::ElementaryTest {
   public:
    explicit Forgetful(const bool& forgets) : forgets_(forgets) {}
    detector::ContactResult test(const detector::FourPoints& query,
                                 detector::Want want) const override {
      return forgets_ ? detector::ContactResult{} : ElementaryTest::test(query, want);
    }

   private:
    const bool& forgets_;
  };
  const auto step = step_at_first_contact("dented-sphere", 1'280);
  ASSERT_TRUE(step);
  bool forgets = false;
  const auto options = bench_options(detector::Culling::view_point);
  auto stages = detector::standard_stages(options);
  stages.elementary = std::make_shared<Forgetful>(forgets);
  BenchReport report;
  TimedStep timed("dent", step->triangles, step->frames, options, stages, report);
  timed.time();
  timed.time();
  EXPECT_TRUE(report.wrong_answers.empty());
  forgets = true;
  timed.time();
  EXPECT_EQ(report.wrong_answers.size(), 1u);
}

class Suites : public testing::Test {
 protected:
  BenchReport run(RunSuite& suite) {
    BenchReport report = suite({"/nowhere", 0.01}, {});
    EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
    const auto json = to_json(report, "version");
    EXPECT_EQ(json["schema"], "assay-bench/1");
    EXPECT_EQ(json["rows"].size(), report.rows.size());
    for (const auto& row : report.rows) {
      EXPECT_TRUE(!row.measured || std::isfinite(row.measured->value)) << row.label;
    }
    return report;
  }
  static bool has(const BenchReport& report, const std::string& start) {
    return std::any_of(report.rows.begin(), report.rows.end(),
                       [&](const auto& row) { return row.label.starts_with(start); });
  }
};

TEST_F(Suites, Elementary) {
  const auto report = run(elementary_suite);
  for (const char* row : {"yes/no, candidates of rod-twist", "simulation queries",
                          "hand-made queries", "p99.9 of one query, exponents within 2^+-100",
                          "p99.9 of one query, exponents over all doubles",
                          "p99.9 of one query, kept family, vertex-face",
                          "slowest query, kept family, view from a line"}) {
    EXPECT_TRUE(has(report, row)) << row;
  }
}

TEST_F(Suites, View) {
  const auto report = run(view_suite);
  for (const char* row :
       {"writing swept boxes, point, sphere", "view test over boxes, line, bent tube, baseline",
        "free step over bvh's, view-point", "free step, view-point",
        "V0 beyond the exact V0, view-line, bounded", "V+ or V- on scene twist, view-line",
        "V+ of the bunny"}) {
    EXPECT_TRUE(has(report, row)) << row;
  }
}

TEST_F(Suites, Growth) {
  const auto report = run(growth_suite);
  for (const char* row :
       {"preprocessing, 320", "preprocessing: exponent of growth", "free step: exponent of growth",
        "step with contacts: exponent of growth"}) {
    EXPECT_TRUE(has(report, row)) << row;
  }
}

TEST_F(Suites, Sizes) {
  const auto report = run(sizes_suite);
  for (const char* row :
       {"crumpled body: step, bvh", "pile of 1,000 bodies: step, bvh, first over all",
        "knot: the oracle's judgement", "hair of 5,000 strips: create, auto over bvh",
        "cloth of 50 layers: memory", "one large body: one thread over two"}) {
    EXPECT_TRUE(has(report, row)) << row;
  }
  const auto scenes = to_json(report, "version")["sizes"];
  EXPECT_EQ(scenes.size(), 6u);
  for (const auto& scene : scenes) EXPECT_GT(scene["triangles"], 300) << scene;
}

TEST_F(Suites, Claims) {
  const auto report = run(claims_suite);
  for (const char* row :
       {"box tests of the vBVHs over bvh's, dented-sphere", "box tests with skipping over without",
        "time of a child count over a box test", "marking's share of a step, crumpling-sphere",
        "looks at the tree in free steps, view-line", "rod-twist", "unclosed, thick-cloth",
        "unclosed, codim-ipc-kick", "exact over double, whole step",
        "largest time over bvh's, view-line", "view-auto over normal-cone, steps of bend",
        "break-even share of V+ with bvh, view-point, last crossing",
        "break-even share of V+ with normal-cone, view-line, last crossing"}) {
    EXPECT_TRUE(has(report, row)) << row;
  }
  // Scenes, steps, cullings, what they are compared with.
  EXPECT_EQ(report.figures.at("scatter").size(), corpus::scenes().size() * 20u * 3u * 2u);
}

TEST_F(Suites, Sequences) {
  const auto report = run(sequences_suite);
  for (const char* row : {"bend, view-line, 1 thread: sum over bvh's",
                          "twist, auto over the best single culling, sum",
                          "open-tube, auto over the best single culling, median step",
                          "arm-in-box, auto over bvh, first step"}) {
    EXPECT_TRUE(has(report, row)) << row;
  }
  EXPECT_TRUE(report.wrong_answers.empty()) << report.wrong_answers[0];
}

TEST_F(Suites, Stages) {
  const auto report = run(stages_suite);
  for (const char* row : {"rod-twist", "layered-cloth: step", "crumpling-sphere: boxes",
                          "crumpling-sphere: descent", "crumpling-sphere: feature pairs",
                          "folding-sheet: the boxes of all candidates in a bare loop"}) {
    EXPECT_TRUE(has(report, row)) << row;
  }
  EXPECT_TRUE(report.wrong_answers.empty()) << report.wrong_answers[0];
}

TEST_F(Suites, Threads) {
  const auto report = run(threads_suite);
  for (const char* row :
       {"plain pass: one thread over", "free step: one thread over",
        "free step's gain over the plain pass's", "crumpling-sphere: memory a further thread, of 4",
        "crumpling-sphere, auto: 16 cores, by the critical path", "a public sequence"}) {
    EXPECT_TRUE(has(report, row)) << row;
  }
}

// Four pieces of the same length in two lanes save half of their time, and the result of a loop is
// that of any other arena.
TEST(MeasuringArena, SavesWhatOtherLanesWouldDo) {
  MeasuredLoops loops;
  const detector::Workers workers(make_measuring_arena(2, loops), 2);
  std::vector<int> seen(4, 0);
  workers.share_out(4, 1, [&](const detector::LoopPiece& piece) {
    EXPECT_LT(piece.lane, 2u);
    ++seen[piece.begin];
    const double until = processor_ns() + 2e6;
    while (processor_ns() < until) {
    }
  });
  EXPECT_EQ(seen, std::vector<int>(4, 1));
  EXPECT_GE(loops.pieces, 8e6);
  EXPECT_GE(loops.longest_lanes, loops.pieces / 2);
  EXPECT_LT(loops.longest_lanes, loops.pieces);
  EXPECT_GT(loops.saved(), 0);
}

TEST_F(Suites, Harness) {
  const auto report = run(harness_suite);
  for (const char* row : {"oracle, rod-twist step", "oracle, a simulation query, yes/no",
                          "oracle, a feature candidate of the bend scene",
                          "judged steps a second and core, closed-generic",
                          "judged steps a second and core, unclosed-degenerate"}) {
    EXPECT_TRUE(has(report, row)) << row;
  }
  const auto wants = [&](const std::string& row) {
    const auto found = std::find_if(report.rows.begin(), report.rows.end(),
                                    [&](const auto& r) { return r.label == row; });
    return found != report.rows.end() && found->wanted ? found->wanted->bound : 0;
  };
  EXPECT_EQ(wants("judged steps a second and core, closed-generic"), 100);
  EXPECT_EQ(wants("judged steps a second and core, closed-degenerate"), 10);
  EXPECT_EQ(wants("oracle, a feature candidate of the bend scene"), 10);
}

TEST(BenchCommand, RefusesWhatItCannotDo) {
  for (const std::string arguments :
       {"--suite nonsense", "", "--suite view --svg x.svg", "--suite view --json /nowhere/x"}) {
    const auto outcome = tests::run_assay("bench " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

}  // namespace
}  // namespace assay::reports
