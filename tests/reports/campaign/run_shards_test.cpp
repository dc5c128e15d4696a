// `assay run --shard I/N`: one part of a campaign.
#include "tests/reports/run_fixture.h"

namespace assay::tests {
namespace {

class RunShards : public RunFixture {};

TEST_F(RunShards, ShareAFolder) {
  std::size_t trials = 0;
  for (const std::string shard : {"1/3", "2/3", "3/3"}) {
    const auto part = run("--shard " + shard + " --detector " + plugin("always_free"));
    EXPECT_EQ(part.exit_code, 1) << part.out << part.err;
    EXPECT_TRUE(contains(part.out, "shard " + shard)) << part.out;
    // Lines of earlier shards go on to name their own failures.
    for (const auto& line : replay_lines(part.out)) {
      EXPECT_EQ(run_assay(line).exit_code, 1) << line;
    }
    const auto store =
        properties::Store::read(out + "/shard-" + shard.substr(0, 1) + "-of-3.sqlite");
    ASSERT_TRUE(store) << store.error().message;
    trials += store.value().trial_count();
  }
  EXPECT_EQ(trials, 32u);
}

TEST_F(RunShards, AreNotHeldToTheBoundOfAll) {
  plan = scratch.write("plan.json",
                       R"({"schema": "assay-campaign/1", "name": "small", "seconds": 20,
          "strata": [{"family": "closed-generic", "cases": 8, "bound": 0.01},
                     {"family": "broken", "cases": 1, "bound": 0.01}]})");
  for (const std::string shard : {"1/2", "2/2"}) {  // the second has no case of the last stratum
    const auto outcome = run("--shard " + shard);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_TRUE(contains(outcome.out, "\nholds: 0 trials with a defect")) << outcome.out;
    const auto summary = out + "/summary-shard-" + shard.substr(0, 1) + "-of-2.md";
    EXPECT_TRUE(contains(read_text(summary), "## Assay: holds\n")) << read_text(summary);
  }
}

}  // namespace
}  // namespace assay::tests
