// Whatever a plug-in tries, no verb holds it for right, and the isolation that it had is said.
#include <cstdlib>
#include <deque>
#include <future>
#include <map>
#include <utility>

#include "tests/reports/run_fixture.h"

namespace assay::tests {
namespace {

class HostilePlugin : public RunFixture {
 protected:
  // In the environment of the program: what hostile.cpp does.
  static void does(const std::string& mode) { setenv("ASSAY_HOSTILE", mode.c_str(), 1); }
  HostilePlugin() {
    plan =
        scratch.write("plan.json", R"({"schema": "assay-campaign/1", "name": "tiny",)"
                                   R"( "seconds": 60, "case_seconds": 0.1, "shrink_share": 0.01,)"
                                   R"( "strata": [{"family": "closed-generic", "cases": 6}]})");
    setenv("ASSAY_VICTIM", scratch.write("victim", "whole").c_str(), 1);
    setenv("ASSAY_BYSTANDER", "0", 1);
  }
  const std::string hostile = plugin("hostile");
  const std::string without_landlock = std::string(ASSAY_PLUGIN_DIR) + "/without_landlock ";
};

const char* const modes[] = {"forge-no-steps",
                             "forge-more-steps",
                             "forge-not-run",
                             "forge-hung",
                             "forge-crashed",
                             "forge-end",
                             "forge-answer",
                             "forge-number",
                             "forge-place",
                             "forge-text",
                             "forge-long-text",
                             "forge-no-interval",
                             "forge-pair-beyond",
                             "forge-pair-twice",
                             "forge-views",
                             "forge-counts",
                             "forge-bool",
                             "forge-garbage",
                             "forge-nothing",
                             "forge-lies",
                             "forge-length",
                             "forge-name",
                             "forge-margin",
                             "overwrite",
                             "unlink",
                             "daemon",
                             "kill-parents",
                             "trace-bystander",
                             "memory-of-parent",
                             "descriptors",
                             "close-descriptors",
                             "descriptors-of-parent",
                             "socket",
                             "terminal",
                             "stop-itself",
                             "kill-itself",
                             "deep-stack",
                             "hang-at-load",
                             "hang-at-create",
                             "hang-at-evaluate",
                             "hang-at-result",
                             "exit-at-load",
                             "exit-at-describe",
                             "exit-at-create",
                             "exit-at-evaluate",
                             "exit-at-commit",
                             "exit-at-destroy"};

// Most of them are waited for, so several are at work at a time.
TEST_F(HostilePlugin, NoneHoldsInACheck) {
  constexpr std::size_t at_a_time = 8;
  std::deque<std::pair<const char*, std::future<Outcome>>> at_work;
  std::size_t next = 0;
  while (next < std::size(modes) || !at_work.empty()) {
    if (next < std::size(modes) && at_work.size() < at_a_time) {
      const char* const mode = modes[next++];
      at_work.emplace_back(mode, std::async(std::launch::async, [this, mode] {
                             return run_assay("check --time 0.2 --detector " + hostile + " " +
                                                  curated("A1_winding2_allpositive"),
                                              std::string("ASSAY_HOSTILE=") + mode + " ");
                           }));
      continue;
    }
    const char* const mode = at_work.front().first;
    const auto ended = at_work.front().second.get();
    at_work.pop_front();
    EXPECT_TRUE(ended.exit_code == 1 || ended.exit_code == 2 || ended.exit_code == 3)
        << mode << ": " << ended.exit_code << ended.out << ended.err;
    EXPECT_EQ(read_text(scratch / "victim"), "whole") << mode;
  }
}

TEST_F(HostilePlugin, NoneHoldsInACampaign) {
  for (const char* mode : {"forge-no-steps", "forge-lies", "overwrite", "daemon", "kill-parents",
                           "kill-itself", "hang-at-evaluate", "exit-at-evaluate"}) {
    does(mode);
    out = scratch / mode;
    const auto ended = run("--jobs 2 --detector " + hostile);
    EXPECT_TRUE(ended.exit_code == 1 || ended.exit_code == 3)
        << mode << ": " << ended.exit_code << ended.out << ended.err;
    EXPECT_TRUE(contains(ended.out, "\nisolation: ")) << ended.out;
    EXPECT_FALSE(contains(read_text(out + "/summary.md"), "## Assay: certified")) << mode;
    EXPECT_TRUE(contains(read_text(out + "/summary.md"), "isolation "))
        << read_text(out + "/summary.md");
    EXPECT_EQ(read_text(scratch / "victim"), "whole") << mode;
  }
}

TEST_F(HostilePlugin, WhatTheSystemLacksIsSaidOrRefused) {
  does("");
  const std::string check =
      "check --detector " + hostile + " " + curated("A1_winding2_allpositive") + " --isolation ";
  EXPECT_TRUE(contains(run_assay(check + "none").out, "\nisolation: none\n"));
  for (const auto& [prefix, lacks] : std::map<std::string, std::string>{
           {without_landlock, "partial: lacks files"},
           {without_landlock + "-n ", "partial: lacks files, processes"}}) {
    const auto best = run_assay(check + "best", prefix);
    EXPECT_EQ(best.exit_code, 1) << best.err;
    EXPECT_TRUE(contains(best.out, "\nisolation: " + lacks + "\n")) << best.out;
    expect_refused(run_assay(check + "required", prefix),
                   "isolation is required, and this system's is " + lacks);
  }
}

TEST_F(HostilePlugin, FewDescriptorsOrProcessesAreNoExcuse) {
  for (const char* limit : {"ulimit -n 16; ", "ulimit -u 64; ", "ulimit -f 1000; "}) {
    does("forge-no-steps");
    const auto ended =
        run_assay("check --detector " + hostile + " " + curated("A1_winding2_allpositive"), limit);
    EXPECT_TRUE(ended.exit_code == 1 || ended.exit_code == 2)
        << limit << ended.exit_code << ended.err;
  }
}

}  // namespace
}  // namespace assay::tests
