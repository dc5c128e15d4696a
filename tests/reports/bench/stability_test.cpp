// Suite `stability`: right arithmetic is shown as right, and each arithmetic that is wrong on
// purpose is shown with its kind of error.

#include "detector/step/stages.h"
#include "properties/judging/case_options.h"
#include "properties/judging/exam.h"
#include "properties/laws/metamorphic/change_laws.h"
#include "reports/bench/compared/comparison.h"
#include "tests/reports/json_schema.h"
#include "tests/test.h"

namespace assay::reports {
namespace {

using corpus::HardFamily, detector::ContactResult, detector::FourPoints, detector::Want;

constexpr double tests_scale = 0.01;

struct Measured {
  BenchReport report;

  nlohmann::json cells() const { return to_json(report, "version")["heat"]; }
  // The sum of a count over all cells: "right", "errors/missed".
  std::uint64_t sum(const std::string& count) const {
    std::uint64_t all = 0;
    for (const auto& cell : cells())
      all += cell.at(nlohmann::json::json_pointer("/" + count)).get<std::uint64_t>();
    return all;
  }
};

Measured report_of(std::string_view family, const BenchSubject& subject) {
  const auto& found = *std::ranges::find(corpus::hard_families(), family, &HardFamily::name);
  return {stability_of({&found, 1}, {subject}, {"/nowhere", tests_scale}, {})};
}

BenchSubject wrong(detector::Arithmetic arithmetic, MakeStages stages) {
  auto subject = variant_of(arithmetic, detector::Culling::view_point, detector::Pairs::all);
  subject.name = "wrong";
  subject.stages = std::move(stages);
  return subject;
}

// Exact stages, but for one.
template <class Elementary>
BenchSubject with_elementary(detector::Arithmetic arithmetic) {
  return wrong(arithmetic, [](const detector::Options& options) {
    auto stages = detector::standard_stages(options);
    stages.elementary = std::make_shared<Elementary>();
    return stages;
  });
}

const BenchRow& row_that_starts(const BenchReport& report, const std::string& start) {
  return *std::find_if(report.rows.begin(), report.rows.end(),
                       [&](const auto& row) { return row.label.starts_with(start); });
}

class ForgetsTheEnd : public detector::ElementaryTest {
  ContactResult test(const FourPoints& query, Want) const override {
    const auto result = ElementaryTest::test(query, Want::first_time);
    return result.contact && result.time.lo == 1 ? ContactResult{} : result;
  }
};

TEST(Stability, AMissAtTheEndIsAMiss) {
  const auto done =
      report_of("contact-at-end", with_elementary<ForgetsTheEnd>(detector::Arithmetic::exact));
  const auto& row = row_that_starts(done.report, "contact-at-end, wrong: wrong");
  EXPECT_STREQ(row.outcome(), "fails");
  // It breaks at the first strength that is not all right.
  EXPECT_TRUE(says(row.note, " 0 (touching), right at 2^"));
  EXPECT_FALSE(done.report.wrong_answers.empty());
  // Only what touches at t=1 is lost.
  for (const auto& cell : done.cells()) {
    const auto& errors = cell["errors"];
    EXPECT_EQ(errors["missed"], cell["exponent"].is_null() ? errors["steps"].get<int>() : 0);
    EXPECT_EQ(errors["alarming"], 0);
  }
}

class ComesLate : public detector::ElementaryTest {
  ContactResult test(const FourPoints& query, Want want) const override {
    auto result = ElementaryTest::test(query, want);
    if (result.contact) result.time = {result.time.lo + 0x1p-10, result.time.lo + 0x1p-10};
    return result;
  }
};

TEST(Stability, ALateTimeIsLateAndMeasured) {
  const auto done = report_of("grazing", with_elementary<ComesLate>(detector::Arithmetic::bounded));
  const auto late = done.sum("errors/late/steps");
  EXPECT_GT(late, 0u);
  EXPECT_EQ(done.sum("errors/unsafe"), late);
  EXPECT_EQ(done.sum("errors/missed"), 0u);
  EXPECT_EQ(done.sum("right"), done.sum("cases"));
  EXPECT_LT(done.sum("exactly_right"), done.sum("cases"));
  EXPECT_STREQ(row_that_starts(done.report, "grazing, wrong: missed, late").outcome(), "fails");
  EXPECT_TRUE(says(row_that_starts(done.report, "grazing, wrong: right").note, "never wrong"));
  // All first times are 1/2, where an ulp is 2^-53.
  for (const auto& cell : done.cells()) {
    const auto& off = cell["errors"]["late"];
    if (off["steps"] == 0) continue;
    EXPECT_EQ(off["worst_share"], 0x1p-10);
    EXPECT_EQ(off["worst_ulps"], 0x1p-10 / 0x1p-53);
  }
  EXPECT_FALSE(done.report.wrong_answers.empty());
}

class SeesTooMuch : public detector::ElementaryTest {
  ContactResult test(const FourPoints&, Want) const override {
    ContactResult result;
    result.contact = true;
    return result;
  }
};

TEST(Stability, FalseAlarmsAreAlarming) {
  const auto done =
      report_of("short-steps", with_elementary<SeesTooMuch>(detector::Arithmetic::exact));
  EXPECT_GT(done.sum("errors/alarming"), 0u);
  EXPECT_GT(done.sum("errors/early/steps"), 0u);
  EXPECT_EQ(done.sum("errors/missed"), 0u);
  EXPECT_FALSE(done.report.wrong_answers.empty());
}

class CallsZeroPositive : public detector::ViewClassifier {
  bool classify(const detector::Topology& surface, const detector::Component& component,
                const detector::SteppedMesh& motion, const detector::ViewPrimitive& primitive,
                std::vector<detector::ViewSign>& signs, detector::ViewCounts& counts,
                detector::PacedStop& pace) const override {
    ViewClassifier::classify(surface, component, motion, primitive, signs, counts, pace);
    for (const auto t : component.triangles) {
      auto& sign = signs[static_cast<std::size_t>(t)];
      if (sign == detector::ViewSign::zero) sign = detector::ViewSign::positive;
    }
    return true;
  }
};

TEST(Stability, AWrongViewSignIsWrong) {
  const auto subject = wrong(detector::Arithmetic::bounded, [](const detector::Options& options) {
    auto stages = detector::standard_stages(options);
    stages.classifier = std::make_shared<CallsZeroPositive>();
    return stages;
  });
  for (const auto* family : {"view-touches-zero", "view-on-surface", "view-line-ends"}) {
    const auto done = report_of(family, subject);
    EXPECT_GT(done.sum("wrong_signs"), 0u) << family;
    EXPECT_LT(done.sum("right"), done.sum("cases")) << family;
    EXPECT_FALSE(done.report.wrong_answers.empty()) << family;
  }
}

// It prefers one end of the axes.
class DependsOnNumbering : public detector::ElementaryTest {
  ContactResult test(const FourPoints& query, Want want) const override {
    auto result = ElementaryTest::test(query, want);
    if (query.points[0].t0[0] < query.points[1].t0[0]) result = {};
    return result;
  }
};

TEST(Stability, ChangesShowWhatDependsOnThem) {
  const auto report =
      report_of("near-parallel", with_elementary<DependsOnNumbering>(detector::Arithmetic::exact))
          .report;
  const auto survived = [&](const std::string& change) {
    return row_that_starts(report, "answers that survive the change " + change).estimate->value;
  };
  EXPECT_LT(survived("mirror"), 100);
  EXPECT_EQ(survived("power of two"), 100);
  EXPECT_EQ(survived("translation"), 100);
}

// Every change keeps what the oracle says of the case.
TEST(Stability, ChangesChangeNothing) {
  int changed = 0, cases = 0;
  for (const auto& family : corpus::hard_families()) {
    if (family.name == "coplanar") continue;
    for (int variant = 0; variant < family.kinds; ++variant) {
      const auto c = corpus::hard_case(family, family.strongest / 2, variant);
      const auto run = [](const corpus::Case& one) {
        auto options = properties::options_of(one);
        if (!one.options.contains("culling")) options.culling = detector::Culling::view_point;
        const SweptSubject exact{nullptr, {"exact", options}};
        return sweep(one, {&exact, 1}, {.rounds = 0})[0].first->steps[0];
      };
      const auto original = run(c);
      for (const auto& [name, make] : case_changes()) {
        ++cases;
        const auto other = make(c);
        if (!other) continue;
        ++changed;
        EXPECT_FALSE(other->c.frames == c.frames) << c.id << ", " << name;
        EXPECT_EQ(properties::difference_in_form(original, *other, run(other->c)), "")
            << c.id << ", " << name;
        EXPECT_EQ(properties::judge_case(other->c)[0].answer, original.answer)
            << c.id << ", " << name;
      }
    }
  }
  EXPECT_GT(changed, 0.9 * cases);
}

TEST(Stability, ExactIsNeverWrongAndBoundedNeverMisses) {
  const auto report =
      stability_of(corpus::hard_families(), all_arithmetics(), {"/nowhere", tests_scale}, {});
  EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
  int exact_rows = 0, bounded_rows = 0;
  for (const auto& row : report.rows) {
    EXPECT_STRNE(row.outcome(), "fails") << row.label;
    const bool holds = row.outcome() == std::string("holds");
    exact_rows += row.label.ends_with(", exact: wrong") && holds;
    bounded_rows += row.label.ends_with(", bounded: missed, late, wrong V+ or V-") && holds;
  }
  EXPECT_EQ(exact_rows, 20);
  EXPECT_EQ(bounded_rows, 20);
  const auto json = to_json(report, "version");
  tests::expect_schema("bench", json);
  // The families are hard: the others break.
  std::map<std::string, int> wrong;
  std::map<std::string, std::string> breaks;  // by the beginning of a row: the least such strength
  for (const auto& cell : json["heat"]) {
    const auto arithmetic = cell["arithmetic"].get<std::string>();
    const int cases = cell["cases"], right = cell["right"];
    EXPECT_GT(cases, 0);
    EXPECT_EQ(cell["share_right"], static_cast<double>(right) / cases);
    wrong[arithmetic] += cases - right;
    const auto& exponent = cell["exponent"];
    if (right < cases)
      breaks.try_emplace(cell["family"].get<std::string>() + ", " + arithmetic + ": right",
                         exponent.is_null() ? "0 (touching)" : "2^" + exponent.dump());
  }
  EXPECT_EQ(wrong["exact"], 0);
  EXPECT_GT(wrong["bounded"], 0);
  EXPECT_GT(wrong["double"], 0);
  EXPECT_GT(wrong["float"], wrong["double"]);
  for (const auto& [start, knob] : breaks) {
    const auto& note = row_that_starts(report, start).note;
    EXPECT_LT(note.find(knob), note.find_first_of(",;", note.find('^') + 1)) << start << note;
  }
}

}  // namespace
}  // namespace assay::reports
