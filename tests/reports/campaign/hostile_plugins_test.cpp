// Whatever goes wrong in a plug-in, no verb says that it holds, and each verb names the isolation
// in which the plug-in ran. tests/reports/hostile has the complete table, through `certify`, too.
#include <deque>
#include <future>

#include "tests/reports/hostile_fixture.h"

namespace assay::tests {
namespace {

// Most of them are waited for, so several are at work at a time.
TEST_F(HostilePlugin, NoneHoldsInACheck) {
  if (is_let_loose()) GTEST_SKIP() << properties::fault_of_bubblewrap();
  std::vector<HostileMode> modes = quick_modes();
  modes.insert(modes.end(), hanging_modes().begin(), hanging_modes().end());
  constexpr std::size_t at_a_time = 8;
  std::deque<std::pair<std::string, std::future<Outcome>>> at_work;
  std::size_t next = 0;
  while (next < modes.size() || !at_work.empty()) {
    if (next < modes.size() && at_work.size() < at_a_time) {
      const std::string mode = modes[next++].name;
      at_work.emplace_back(mode, std::async(std::launch::async, [this, mode] {
                             return run_assay("check --time 0.2 --detector " + hostile + " " +
                                                  curated("A1_winding2_allpositive"),
                                              "ASSAY_HOSTILE=" + mode + " ");
                           }));
      continue;
    }
    const std::string mode = at_work.front().first;
    const auto ended = at_work.front().second.get();
    at_work.pop_front();
    EXPECT_TRUE(ended.exit_code == 1 || ended.exit_code == 2 || ended.exit_code == 3)
        << mode << ": " << ended.exit_code << ended.out << ended.err;
    expect_unharmed(mode);
  }
}

TEST_F(HostilePlugin, NoneHoldsInACampaign) {
  if (is_let_loose()) GTEST_SKIP() << properties::fault_of_bubblewrap();
  for (const auto& mode : quick_modes())
    expect_no_verdict_bought("run", mode, judge("run", mode.name));
}

// What the corpus shows takes a certificate half a minute; these end before.
TEST_F(HostilePlugin, NoneThatIsRefusedGetsACertificate) {
  if (is_let_loose()) GTEST_SKIP() << properties::fault_of_bubblewrap();
  for (const auto& mode : quick_modes()) {
    if (mode.exit_codes == std::vector{2})
      expect_no_verdict_bought("certify", mode, judge("certify", mode.name));
  }
}

TEST_F(HostilePlugin, WithoutBubblewrapThereAreLimitsAloneAndItIsSaid) {
  if (is_let_loose()) GTEST_SKIP() << properties::fault_of_bubblewrap();
  const std::string check =
      "check --detector " + hostile + " " + curated("A1_winding2_allpositive");
  does("");
  EXPECT_TRUE(contains(run_assay(check).out, "\nisolation: bubblewrap\n"));
  expect_says(run_assay(check + " --isolation limits").out, {"\nisolation: limits alone\n"});
  EXPECT_TRUE(contains(run_assay(check, forbidden_bwrap).out, "\nisolation: limits alone\n"));
  const std::string line = "bubblewrap does not work here: bwrap: not permitted; see --isolation";
  expect_refused(run_assay(check + " --isolation bubblewrap", forbidden_bwrap), line);
  expect_ended(judge("run", "", "", forbidden_bwrap), 1, {"\nisolation: limits alone\n"});
  EXPECT_TRUE(contains(read_text(out + "/summary.md"), "isolation limits alone"));
  for (const char* verb : {"run", "certify"})
    expect_refused(judge(verb, "", "--isolation bubblewrap", forbidden_bwrap), line);
}

// Trials that were judged with limits alone stay so, whatever the run goes on with.
TEST_F(HostilePlugin, ARunThatGoesOnSaysWhatHeldForAllOfIt) {
  if (is_let_loose()) GTEST_SKIP() << properties::fault_of_bubblewrap();
  for (const bool is_first : {true, false}) {
    const auto run = [&](const std::string& isolation) {
      return run_assay("run --campaign " + plan + " --detector " + plugin("wrapped_builtin") +
                       " --out " + scratch / (is_first ? "first" : "last") + " --isolation " +
                       isolation);
    };
    ASSERT_EQ(run(is_first ? "limits" : "bubblewrap").exit_code, 0);
    ASSERT_EQ(run(is_first ? "bubblewrap" : "limits").exit_code, 0);
    const auto summary = read_text(scratch / (is_first ? "first/summary.md" : "last/summary.md"));
    EXPECT_TRUE(contains(summary, "isolation limits alone;")) << summary;
  }
}

// No limit of the user's makes a run hold, and none crashes it or makes it doubt itself.
TEST_F(HostilePlugin, LimitsOfTheUserAreNoExcuse) {
  if (is_let_loose()) GTEST_SKIP() << properties::fault_of_bubblewrap();
  std::set<int> codes;
  for (const char* limit :
       {"--nofile=4", "--nofile=6", "--nofile=8", "--nofile=10", "--nofile=12", "--nofile=16",
        "--as=31000000", "--as=41000000", "--as=46000000", "--as=200000000", "--fsize=512",
        "--fsize=20000", "--fsize=50000", "--fsize=500000"}) {
    for (const char* mode : {"overwrite", "exit-at-evaluate"})
      codes.insert(expect_no_excuse("run", mode, limit));
  }
  EXPECT_TRUE(codes.contains(1) && codes.contains(2)) << "limits that end a run, and that do not";
}

// Whoever has a limit and runs into it is undecided, or has crashed, and says so.
TEST_F(HostilePlugin, MemoryEndsInTheWorker) {
  const auto ended = judge("run", "all-memory", "--memory 100M --case-seconds 2");
  expect_no_verdict_bought("run", {"all-memory", {1}}, ended);
  EXPECT_TRUE(contains(ended.out, "exited with code 3")) << ended.out;
  const auto thrown = judge("run", "all-memory-thrown", "--memory 128M --case-seconds 2");
  expect_no_verdict_bought("run", {"all-memory-thrown", {3}}, thrown);
  const auto summary = read_text(out + "/summary.md");
  EXPECT_TRUE(contains(summary, ", at most 128MB of memory a case")) << summary;
  // Without the option there is a limit too.
  const auto asked = judge("run", "limit-of-memory");
  expect_no_verdict_bought("run", {"limit-of-memory", {1}}, asked);
  EXPECT_TRUE(contains(asked.out, "exited with code 3")) << asked.out;
  expect_refused(judge("run", "", "--memory lots"), "'lots'");
}

// The system does not count those of root.
TEST_F(HostilePlugin, FewProcessesAreNoExcuse) {
  if (is_let_loose()) GTEST_SKIP() << properties::fault_of_bubblewrap();
  namespace fs = std::filesystem;
  fs::permissions(scratch / "", fs::perms::all);
  for (const char* limit : {"--nproc=1", "--nproc=2", "--nproc=3", "--nproc=4", "--nproc=6"})
    expect_no_excuse("run", "overwrite", limit, not_by_root());
}

}  // namespace
}  // namespace assay::tests
