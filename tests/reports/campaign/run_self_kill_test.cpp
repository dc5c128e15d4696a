// Plug-ins that end their own process: on one kind of case always, or now and then. None of them is
// ever certified.
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

class RunSelfKill : public RunFixture {
 protected:
  Outcome verdict(const std::string& name) {
    plan = scratch.write("plan.json", plan_text(100, R"(, "shrink_share": 0.002)"));
    out = scratch / name;
    return run("--jobs 2 --detector " + plugin(name));
  }
};

// On which troubled_builtin.cpp kills itself.
bool is_fatal(std::uint64_t triangles) { return triangles % 5 == 0; }

TEST_F(RunSelfKill, AlwaysOnOneKindOfCaseIsADefectOfTotal) {
  const std::vector<std::pair<std::string, std::string>> ends = {
      {"kills_itself", "killed by signal 9 (Killed), three times in a row"},
      {"terminates_itself", "killed by signal 15 (Terminated), three times in a row"},
      {"segfaults", "killed by signal 11 (Segmentation fault)\n"},
      {"aborts", "killed by signal 6 (Aborted)\n"}};
  for (const auto& [name, how] : ends) {
    SCOPED_TRACE(name);
    const auto ended =
        expect_ended(verdict(name), 1, {"\nDEFECT total: crashed ", "  " + how, "\nDEFECT: "});
    EXPECT_FALSE(contains(ended.out, " ran again")) << ended.out;
    EXPECT_TRUE(contains(read_text(out + "/summary.md"), "## Assay: defect\n"));

    // On that kind of case, on each of them, and on no other.
    const auto store = value_of(properties::Store::read(out + "/run.sqlite"));
    std::uint64_t fatal = 0;
    store.for_each_trial([&](const properties::TrialRecord& trial) {
      EXPECT_EQ(trial.outcomes, is_fatal(trial.triangles) ? "D" : "H") << trial.id;
      fatal += is_fatal(trial.triangles) ? 1 : 0;
    });
    EXPECT_GE(fatal, 10u);
    // Refined, one of the others becomes such a case.
    EXPECT_EQ(signatures_of(out),
              (properties::Counts{{"law L18_RefinedMeshHasTheSameContacts, total: crashed", 1},
                                  {"total: crashed", fatal}}));
  }
}

TEST_F(RunSelfKill, AtRandomDoesNotHoldAndIsNeverCertified) {
  plan = scratch.write("plan.json", plan_text(100, R"(, "shrink_share": 0.002)"));
  const auto made = run_assay("certify --jobs 2 --campaign " + plan + " --out " + out +
                              " --detector " + plugin("killed_at_random"));
  // The third death in a row is the detector's own, be it in the first run of a case or in its
  // second.
  const bool is_defect = contains(made.out, "killed by signal 9 (Killed), three times in a row");
  EXPECT_EQ(made.exit_code, is_defect ? 1 : 3) << made.err;
  expect_says(made.out,
              {" trials ran again: their worker was killed from outside (", "\ncomplete   FAILS\n",
               " of 200 trials were disturbed from outside, 1 % may be\n"});
  EXPECT_EQ(contains(made.out, "\nDEFECT "), is_defect) << made.out;
  EXPECT_FALSE(contains(made.out, "certified")) << made.out;
  const std::string verdict = is_defect ? "defect" : "incomplete";
  expect_says(read_text(out + "/summary.md"), {"## Assay: " + verdict + "\n"});
  const auto p = predicate_in(out);
  EXPECT_EQ(p["verdict"], verdict);
  EXPECT_EQ(p["gates"][3]["gate"], "complete");
  EXPECT_EQ(p["gates"][3]["state"], "fails");
  std::uint64_t disturbed = 0;
  for (const auto& stratum : p["times"]["strata"])
    disturbed += stratum["disturbed"].get<std::uint64_t>();
  EXPECT_GT(disturbed, 2u);
  expect_ended("verify " + out + "/certificate.json", made.exit_code, {"verified: "});
}

}  // namespace
}  // namespace assay::tests
