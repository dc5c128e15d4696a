// A named campaign runs to its end unless its user sets a limit of time.
#include <regex>

#include "tests/reports/campaign/started.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

// What `assay run` says it will do. It does not come to do it.
std::string announced(const std::vector<std::string>& options) {
  const Scratch scratch;
  std::vector<std::string> words = {"run", "--jobs", "1", "--out", scratch / "out"};
  words.insert(words.end(), options.begin(), options.end());
  const Started started(words, scratch / "text");
  std::string text;
  for (int i = 0; i < 3000 && !contains(text, "\nwrites "); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    text = read_text(scratch / "text");
  }
  return text;
}

TEST(RunTimeLimit, SmokeAndQuickHaveNoneButTheUsers) {
  const std::regex until_done("; 1 jobs; until done\n");
  const std::regex until_then("; 1 jobs; until [0-2][0-9]:[0-5][0-9]:[0-5][0-9] at the latest\n");
  for (const std::string name : {"smoke", "quick"}) {
    const auto without = announced({"--campaign", name});
    EXPECT_TRUE(contains(without, "campaign " + name + ", seed 1: ")) << without;
    EXPECT_TRUE(std::regex_search(without, until_done)) << without;
    const auto with = announced({"--campaign", name, "--time", "60"});
    EXPECT_TRUE(std::regex_search(with, until_then)) << with;
  }
  // Longer than a clock counts: no limit, and above all not over at once.
  EXPECT_TRUE(std::regex_search(announced({"--campaign", "smoke", "--time", "1e11"}), until_done));
  const auto nightly = announced({"--campaign", "nightly"});
  EXPECT_TRUE(std::regex_search(nightly, until_then)) << nightly;
}

TEST(RunTimeLimit, MoreThanAClockCountsIsNoLimit) {
  const Scratch scratch;
  const auto plan = scratch.write("plan.json", plan_text(4, R"(, "tetrahedron_seconds": 1e-3)"));
  for (const std::string seconds : {"1e11", "1e300"}) {
    const auto ended =
        run_assay("run --campaign " + plan + " --time " + seconds + " --out " + scratch / seconds);
    EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  }
}

}  // namespace
}  // namespace assay::tests
