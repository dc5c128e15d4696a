// `assay merge` through the program: shards of one campaign come to what one run comes to.
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

class MergeCommand : public testing::Test {
 protected:
  const Scratch scratch;
  const std::string plan = scratch.write("plan.json", plan_text(16, R"(, "shrink_share": 0.002)"));
  Outcome run(const std::string& out, const std::string& more) const {
    return run_assay("run --campaign " + plan + " --out " + scratch / out + " " + more);
  }
};

TEST_F(MergeCommand, ShardsComeToWhatOneRunComesTo) {
  const std::string library = " --detector " + plugin("always_free");
  ASSERT_EQ(run("whole", library).exit_code, 1);
  for (const std::string shard : {"1", "2", "3"}) {
    ASSERT_EQ(run("part" + shard, "--shard " + shard + "/3" + library).exit_code, 1);
  }
  const std::string out = scratch / "merged";
  const auto some =
      run_assay("merge " + scratch / "part1" + " " + scratch / "part3" + " --out " + out);
  EXPECT_EQ(some.exit_code, 0) << some.out << some.err;
  EXPECT_TRUE(contains(some.out, "2 stores of campaign tiny, seed 1: ")) << some.out;
  EXPECT_TRUE(contains(some.out, " trials are absent")) << some.out;
  const auto all = run_assay("merge " + scratch / "part2" + " --out " + out);
  EXPECT_EQ(all.exit_code, 0) << all.out << all.err;
  EXPECT_TRUE(contains(all.out, "32 of 32 trials; writes " + out + "/merged.sqlite\n")) << all.out;
  EXPECT_TRUE(says(all.out, "/assay certify --campaign " + out + "/campaign.json --seed 1" +
                                library + " --out " + out));
  EXPECT_EQ(trials_of(out, "merged"), trials_of(scratch / "whole"));
  EXPECT_EQ(signatures_of(out, "merged"), signatures_of(scratch / "whole"));
  // Failures keep their meshes, and their lines replay.
  const auto lines = replay_lines(all.out);
  ASSERT_FALSE(lines.empty());
  for (const auto& line : lines) {
    EXPECT_TRUE(contains(line, out + "/failures/")) << line;
    EXPECT_TRUE(contains(line, library)) << line;
    EXPECT_EQ(run_assay(line).exit_code, 1) << line;
  }
  EXPECT_TRUE(
      contains(run_assay("list failures " + out).out, "\nDEFECT free-sound: answered free, "));
}

TEST_F(MergeCommand, BadInputIsOneLine) {
  ASSERT_EQ(run("one", "--shard 1/2").exit_code, 0);
  ASSERT_EQ(run("other", "--shard 2/2 --seed 2").exit_code, 0);
  const std::string out = " --out " + scratch / "out";
  expect_refused(run_assay("merge " + scratch / "one"), "--out");
  expect_refused(run_assay("merge" + out), "DIR is required");
  expect_refused(run_assay("merge " + scratch / "none" + out), "none: ");
  std::filesystem::create_directory(scratch / "empty");
  expect_refused(run_assay("merge " + scratch / "empty" + out), "no run is stored here");
  expect_refused(run_assay("merge " + scratch / "one" + " " + scratch / "other" + out),
                 "different runs: seed 1 and 2");
  EXPECT_FALSE(std::filesystem::exists(scratch / "out/merged.sqlite"));
}

}  // namespace
}  // namespace assay::tests
