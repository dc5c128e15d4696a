// The thesis as printed misses, each deviation on its case; and how often, over random cases.
#include "properties/judging/fault_run.h"
#include "tests/curated_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

TEST(AsPrinted, EachDeviationMissesOnItsCase) {
  ASSERT_EQ(deviations().size(), 5u);
  for (const auto& deviation : deviations()) {
    SCOPED_TRACE(deviation.name);
    const Fault* fault = find_fault(deviation.fault);
    ASSERT_NE(fault, nullptr);
    const auto c = tests::curated_case(std::string(fault->curated));
    const auto judgements = judge_case(c);
    const auto defect = [&](const detector::Stages& stages) {
      const auto results = run_case(c, as_printed_options, stages);
      for (std::size_t s = 0; s < results.size(); ++s) {
        const auto diff = compare(results[s], judgements[s], claims_of(as_printed_options));
        if (diff.outcome != Outcome::holds) return true;
      }
      return false;
    };
    EXPECT_FALSE(defect(detector::standard_stages(as_printed_options)));
    EXPECT_TRUE(defect(stages_with(deviation)));
    EXPECT_TRUE(defect(stages_as_printed()));
  }
}

TEST(AsPrinted, TollOfRandomCases) {
  constexpr std::uint64_t cases_of_family = 60;
  const TollTable table = measure_toll("as-printed:1", cases_of_family);
  std::printf("%s", text_of(table).c_str());
  ASSERT_EQ(table.rows.size(), deviations().size() + 2);
  const TollRow &right = table.rows.front(), &printed = table.rows.back();
  EXPECT_EQ(right.silent + right.late + right.incomplete + right.pairs_missing, 0u);
  EXPECT_GT(printed.silent, 0u);
  EXPECT_GT(printed.pairs_missing, 0u);
  EXPECT_LT(printed.candidates, right.candidates);
  const TollTable again = measure_toll("as-printed:1", cases_of_family);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(table.rows[i].pairs_missing, again.rows[i].pairs_missing);
    EXPECT_EQ(table.rows[i].candidates, again.rows[i].candidates);
  }
}

}  // namespace
}  // namespace assay::properties
