// Suite `stability`: right arithmetic is shown as right, and arithmetic that is wrong on purpose as
// wrong in the way that it is.
#include "reports/bench/stability/stability.h"

#include <nlohmann/json.hpp>

#include "detector/step/stages.h"
#include "tests/reports/json_schema.h"
#include "tests/test.h"

namespace assay::reports {
namespace {

using corpus::HardFamily, detector::ContactResult, detector::FourPoints, detector::Want;

const HardFamily& family_named(std::string_view name) {
  const auto all = corpus::hard_families();
  return *std::find_if(all.begin(), all.end(), [&](const auto& f) { return f.name == name; });
}

constexpr double tests_scale = 0.01;

struct Measured {
  BenchReport report;
  std::vector<StabilityCell> cells;

  StabilityCell total() const {
    FamilyStability sum;
    sum.cells = cells;
    return sum.total();
  }
};

Measured report_of(std::string_view family, const StabilitySubject& subject) {
  Measured out;
  out.report = stability_of({&family_named(family), 1}, {&subject, 1}, {"/nowhere", tests_scale},
                            {}, &out.cells);
  return out;
}

// Exact stages, but for one.
template <class Elementary>
StabilitySubject with_elementary(detector::Arithmetic arithmetic) {
  return {"wrong", arithmetic, [](const detector::Options& options) {
            auto stages = detector::standard_stages(options);
            stages.elementary = std::make_shared<Elementary>();
            return stages;
          }};
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
  EXPECT_EQ(row_that_starts(done.report, "contact-at-end, wrong: wrong").outcome(),
            RowOutcome::fails);
  EXPECT_FALSE(done.report.wrong_answers.empty());
  // Only what touches at t=1 is lost.
  for (const auto& cell : done.cells) {
    EXPECT_EQ(cell.errors.missed, cell.touches ? cell.errors.steps : 0) << cell.strength;
    EXPECT_EQ(cell.errors.alarming, 0u);
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
  const auto all = done.total();
  EXPECT_GT(all.errors.late.steps, 0u);
  EXPECT_EQ(all.errors.unsafe, all.errors.late.steps);
  EXPECT_EQ(all.errors.missed, 0u);
  EXPECT_EQ(all.right, all.cases);
  EXPECT_LT(all.exactly_right, all.cases);
  EXPECT_GT(all.refuted, 0);
  // All first times are 1/2, where an ulp is 2^-53.
  EXPECT_EQ(all.errors.late.worst_share, 0x1p-10);
  EXPECT_EQ(all.errors.late.worst_ulps, 0x1p-10 / 0x1p-53);
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
  const auto errors = done.total().errors;
  EXPECT_GT(errors.alarming, 0u);
  EXPECT_GT(errors.early.steps, 0u);
  EXPECT_EQ(errors.missed, 0u);
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
  const StabilitySubject subject{"wrong", detector::Arithmetic::bounded,
                                 [](const detector::Options& options) {
                                   auto stages = detector::standard_stages(options);
                                   stages.classifier = std::make_shared<CallsZeroPositive>();
                                   return stages;
                                 }};
  for (const auto* family : {"view-touches-zero", "view-on-surface", "view-line-ends"}) {
    const auto done = report_of(family, subject);
    const auto all = done.total();
    EXPECT_GT(all.wrong_signs, 0) << family;
    EXPECT_LT(all.right, all.cases) << family;
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
    return row_that_starts(report, "answers that survive " + change).measured->value;
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
      const auto exact = all_arithmetics()[0];
      const auto original = run_hard_case(c, exact);
      for (const auto& change : case_changes()) {
        ++cases;
        const auto other = change.make(c);
        if (!other) continue;
        ++changed;
        EXPECT_FALSE(other->changed.frames == c.frames) << c.id << ", " << change.name;
        EXPECT_TRUE(same_but_for_numbering(original, run_hard_case(other->changed, exact),
                                           other->triangle, true))
            << c.id << ", " << change.name;
        HardTruth truth(other->changed);
        EXPECT_EQ(truth.judgement().answer, original.answer) << c.id << ", " << change.name;
      }
    }
  }
  EXPECT_GT(changed, 0.9 * cases);
}

TEST(Stability, BreaksAtTheFirstStrengthThatIsNotAllRight) {
  FamilyStability found;
  for (const int wrong : {0, 0, 1, 0, 3}) {
    StabilityCell cell;
    cell.strength = static_cast<int>(found.cells.size()) * 5;
    cell.cases = 4;
    cell.right = 4 - wrong;
    found.cells.push_back(cell);
  }
  EXPECT_EQ(found.breaks_at(), 10);
  EXPECT_EQ(found.total().right, 16);
  found.cells.resize(2);
  EXPECT_FALSE(found.breaks_at());
}

TEST(Stability, ExactIsNeverWrongAndBoundedNeverMisses) {
  std::vector<StabilityCell> cells;
  const auto report = stability_of(corpus::hard_families(), all_arithmetics(),
                                   {"/nowhere", tests_scale}, {}, &cells);
  EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
  int exact_rows = 0, bounded_rows = 0;
  for (const auto& row : report.rows) {
    EXPECT_NE(row.outcome(), RowOutcome::fails) << row.label;
    exact_rows += row.label.ends_with(", exact: wrong") && row.outcome() == RowOutcome::holds;
    bounded_rows += row.label.ends_with(", bounded: missed, late, wrong V+ or V-") &&
                    row.outcome() == RowOutcome::holds;
  }
  EXPECT_EQ(exact_rows, 20);
  EXPECT_EQ(bounded_rows, 20);
  // The families are hard: the others break.
  std::map<std::string, int> wrong;
  for (const auto& cell : cells) wrong[cell.arithmetic] += cell.cases - cell.right;
  EXPECT_EQ(wrong["exact"], 0);
  EXPECT_GT(wrong["bounded"], 0);
  EXPECT_GT(wrong["double"], 0);
  EXPECT_GT(wrong["float"], wrong["double"]);

  const auto json = to_json(report, "version");
  tests::expect_schema("bench", json);
  ASSERT_EQ(json["heat"].size(), cells.size());
  for (const auto& cell : json["heat"]) {
    EXPECT_GT(cell["cases"], 0);
    EXPECT_EQ(cell["share_right"].get<double>(),
              cell["right"].get<double>() / cell["cases"].get<double>());
  }
}

}  // namespace
}  // namespace assay::reports
