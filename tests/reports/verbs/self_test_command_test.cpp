// assay self-test, as a user runs it.
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

TEST(SelfTestCommand, HoldsAndSaysSeedAndCounts) {
  const auto outcome = run_assay("self-test --queries 100 --seed 7 --jobs 2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  for (const char* part : {"seed 7", "small-int ", "cube-2 ", "left out", "steps ", "quadratic %",
                           "no contradiction in", "invariances"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  }
}

TEST(SelfTestCommand, ReplaysACaseExactly) {
  const auto outcome = run_assay("self-test --replay dyadics:1:4");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"vertex-face", "0x1",
                           "oracle, timed: ", "detector, integers alone: ", "second referee: "}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  }
  for (const char* family : {"rungs", "steps", "plane-2"}) {
    EXPECT_EQ(run_assay(std::string("self-test --replay ") + family + ":1:0").exit_code, 0);
  }
}

TEST(SelfTestCommand, TimeLimitIsUndecided) {
  const auto outcome = run_assay("self-test --queries 1000000 --time 0.2");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_NE(outcome.out.find("undecided"), std::string::npos);
}

TEST(SelfTestCommand, BadInputIsOneLine) {
  for (const char* arguments :
       {"--replay x", "--replay small-int:1", "--queries 0", "--time -1", "--seed x", "--jobs 0"}) {
    const auto outcome = run_assay(std::string("self-test ") + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

}  // namespace
}  // namespace assay::tests
