// `assay run` on the command line.
#include <fmt/format.h>

#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

class Run : public RunFixture {
 protected:
  void expect_line_under(const std::string& limit) const {
    SCOPED_TRACE(limit);
    const auto ended = run("--jobs 8", limit);
    expect_one_line(ended);
    EXPECT_TRUE(ended.err.starts_with("assay: ")) << ended.err;
  }
};

// The triangles of each kind that is told in a line.
std::vector<int> sizes_told(const std::string& text) {
  const std::regex triangles("\nDEFECT [^\n]*, met [^\n]*: ([0-9]+) triangles");
  std::vector<int> sizes;
  for (std::sregex_iterator at(text.begin(), text.end(), triangles), end; at != end; ++at)
    sizes.push_back(std::stoi((*at)[1]));
  return sizes;
}

TEST_F(Run, SaysWhatItWillDoAndHowItEnded) {
  const auto first = expect_ended(run("--seed 5 --jobs 2"), 0);
  EXPECT_EQ(first.err, "");
  expect_says(
      first.out,
      {"campaign tiny, seed 5: 32 trials of 3 families, 12 configurations; 2 jobs; "
       "until",
       "writes ", "canary pair/zero-zero-dropped: found after", "32 trials in", "stratum",
       "closed-generic           each of 10              16      16       0         0",
       "L3_FirstContactIsACandidate", "\nholds: 0 trials with a defect, 0 undecided, 0 laws broken",
       "writes " + out + "\n"});
  const auto summary = read_text(out + "/summary.md");
  EXPECT_TRUE(contains(summary, "## Assay: holds\n"));
  EXPECT_TRUE(std::regex_search(summary, std::regex(" Begun 20\\d\\d-\\d\\d-\\d\\dT[0-9:]{8}Z\\.")))
      << summary;
  EXPECT_TRUE(contains(read_text(out + "/junit.xml"), "name=\"broken, bvh\"/>"));
  EXPECT_FALSE(contains(first.out, "planted faults"));
  EXPECT_FALSE(contains(first.out, "next:"));

  // The same again has nothing to do and comes to the same.
  const auto trials = trials_of(out);
  const auto again = expect_ended(run("--seed 5 --jobs 1 --time 30"), 0,
                                  {"(32 are stored, 0 to do)", "\nholds: 0 trials with a defect"});
  EXPECT_FALSE(contains(again.out, "trials in ")) << again.out;
  EXPECT_EQ(trials_of(out), trials);
  // Its day as well.
  EXPECT_EQ(read_text(out + "/summary.md"), summary);

  expect_refused(run("--seed 5 --detector " + plugin("always_free")), "holds another run");
  expect_refused(run("--seed 6"),
                 "holds another run: seed 5 and 6; go on in a new folder: --out NEW");
  scratch.write("plan.json", plan_text(18));
  expect_refused(run("--seed 5"), "holds another run: campaign/strata/0/cases ");
  EXPECT_EQ(trials_of(out), trials);
}

TEST_F(Run, AnotherRunInTheSameFolderIsToldByWhatDiffers) {
  // An end more is another file, which a loader takes for the same library.
  const auto library = scratch / "own.so";
  std::filesystem::copy_file(plugin("wrapped_builtin"), library);
  const std::string detector = "--detector " + library;
  ASSERT_EQ(run(detector).exit_code, 0);
  std::ofstream(library, std::ios::app) << "mended";
  const std::string go_on = "; go on in a new folder: --out NEW";
  expect_refused(run(detector),
                 "holds another run: another build of the detector's library" + go_on);
  std::string err = run("--seed 7 " + detector).err;
  expect_says(err, {"seed ", "another build of the detector's library"});
  err = run("--detector " + plugin("always_free")).err;
  EXPECT_TRUE(contains(err, "detector \"")) << err;
}

TEST_F(Run, JobsDoNotChangeTheTallies) {
  EXPECT_EQ(run("--jobs 1").exit_code, 0);
  const auto alone = trials_of(out);
  EXPECT_EQ(alone.size(), 32u);
  out = scratch / "together";
  EXPECT_EQ(run("--jobs 3").exit_code, 0);
  EXPECT_EQ(trials_of(out), alone);
}

// One bug is many kinds of failure: what all of these share is told, and not what cases that hold
// have nearly as often.
TEST_F(Run, WhatAllLostContactsShareIsTold) {
  const auto plan = scratch.write("many.json", plan_text(80, R"(, "shrink_share": 0.01)"));
  const auto judged = [&](const std::string& library) {
    return run_assay("run --campaign " + plan + " --out " + out + "-" + library + " --detector " +
                     plugin(library))
        .out;
  };
  const std::pair<std::string, std::string> bugs[] = {
      {"fault_elementary_only-vertex-face", "edge-edge"},
      {"fault_elementary_end-excluded", "t at 1"}};
  for (const auto& [library, shared] : bugs) {
    const auto said = judged(library);
    const std::regex told(
        "\nall \\d+ kinds of failure lose a contact: [^\n]*" + shared +
        R"([^\n]* \(of \d+ colliding cases without a failure, \d ha(s|ve) such a contact\)\n)");
    std::smatch line;
    ASSERT_TRUE(std::regex_search(said, line, told)) << said;
    const auto listed = run_assay("list failures " + out + "-" + library).out;
    EXPECT_EQ("\n" + listed.substr(0, listed.find('\n') + 1), line.str());
  }
  // The first misses everything, so that nothing tells one contact from another; of the second too
  // few cases fail for what they share.
  for (const std::string library : {"always_free", "fault_search_fitted-once"}) {
    const auto said = judged(library);
    EXPECT_TRUE(contains(said, "\nDEFECT: ")) << said;
    EXPECT_FALSE(contains(said, "such a contact")) << said;
  }
}

// Two mistakes in one detector are two groups, each with a mesh of its own, in each text.
TEST_F(Run, KindsOfFailureAreGroupedByWhatOneChangeWouldMend) {
  const auto plan = scratch.write("two.json", R"({
      "schema": "assay-campaign/1", "name": "two", "seconds": 600, "shrink_share": 0.01, "strata": [
        {"family": "unclosed-everyday", "cases": 200}, {"family": "closed-degenerate", "cases": 200}]})");
  const auto said = run_assay("run --campaign " + plan + " --out " + out + " --detector " +
                                  plugin("wrong_wrapper"),
                              "ASSAY_TEST_WRONG=7,11 ")
                        .out;
  const auto listed = "\n" + run_assay("list failures " + out).out;
  for (const std::string mistake : {"edge-edge", "t at 0"}) {
    const std::regex line(R"(\n(\d+ of \d+ kinds of failure lose a contact: )" + mistake +
                          R"( \(.*\))\n  the smallest: ([^\n]*): \d+ triangles, )");
    std::smatch group;
    ASSERT_TRUE(std::regex_search(said, group, line)) << said;
    EXPECT_TRUE(contains(group.str(2), ", " + mistake + ", ")) << said;
    EXPECT_TRUE(contains(listed, group.str(0))) << listed;
    EXPECT_TRUE(contains(read_text(out + "/junit.xml"), "\ngroup: " + group.str(1) + "\n"));
    EXPECT_TRUE(contains(read_text(out + "/summary.md"),
                         "\n- " + group.str(1) + "; the smallest: " + group.str(2) + "\n"));
  }
}

TEST_F(Run, ADefectHasAllThatIsNeededToSeeIt) {
  // A space in a name must not break the line.
  out = "'" + scratch / "with space" + "'";
  const auto outcome =
      expect_ended(run("--detector " + plugin("always_free")), 1,
                   {"plug-in constant answer 1\nclaims: free-sound, ",
                    "contract: leaves nothing out", "whatever is claimed",
                    "DEFECT free-sound: answered free, ", "\nDEFECT: ", "triangles ", " -> "});
  // The line to paste works as it stands: no shell finds this assay by its name.
  const auto next = outcome.out.find("next: ") + std::string("next: ").size();
  const auto pasted = outcome.out.substr(next, outcome.out.find('\n', next) - next);
  EXPECT_TRUE(contains(pasted, "/assay report '")) << outcome.out;
  EXPECT_EQ(exit_code_of(pasted + " >/dev/null"), 0) << pasted;
  // One kind of failure is told in full, every other one in a line; the list has all in full.
  const auto printed = replay_lines(outcome.out);
  ASSERT_EQ(printed.size(), 1u) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "each with the line that replays it: ")) << outcome.out;
  const auto listed = expect_ended("list failures " + out, 0);
  const auto lines = replay_lines(listed.out);
  EXPECT_NE(std::find(lines.begin(), lines.end(), printed.front()), lines.end());
  const std::regex in_a_line("\nDEFECT [a-z-]+: [^\n]*, met [^\n]*: 2 triangles, [^\n]*, 1 step\n");
  std::smatch kind;
  EXPECT_TRUE(std::regex_search(outcome.out, kind, in_a_line)) << outcome.out;
  // Ten kinds are told; the rest is one count.
  ASSERT_GT(lines.size(), 10u) << listed.out;
  EXPECT_EQ(count_of(outcome.out, "\nDEFECT "), 10u) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, fmt::format("\nand {} more kinds of ", lines.size() - 10)));
  for (const auto& line : lines) {
    expect_says(line, {"/failures/tiny-1-", "-smallest.json"});
    expect_ended(line, 1, {"DEFECT free-sound: answered free"});
  }
  std::size_t smallest = 0;
  for (const auto& file : std::filesystem::directory_iterator(scratch / "with space/failures"))
    smallest += contains(file.path().string(), "-smallest.json");
  EXPECT_EQ(smallest, lines.size());
  // The same line for readers who have no folder of this machine.
  const std::string folder = scratch / "with space", summary = read_text(folder + "/summary.md");
  EXPECT_TRUE(contains(summary, "\n    assay replay failures/tiny-1-")) << summary;
  for (const auto& told : {summary, read_text(folder + "/junit.xml")}) {
    EXPECT_FALSE(contains(told, scratch / "")) << told;
    EXPECT_FALSE(contains(told, ASSAY_PLUGIN_DIR)) << told;
  }
  EXPECT_TRUE(contains(read_text(folder + "/summary.md"), "## Assay: defect\n"));
  EXPECT_TRUE(contains(read_text(folder + "/junit.xml"), "<failure message="));
  const std::regex other("\n  also tiny:1:[^\n]*\n    ([^\n]*-original.json'[^\n]*)\n");
  ASSERT_TRUE(std::regex_search(listed.out, kind, other)) << listed.out;
  EXPECT_EQ(exit_code_of(kind.str(1) + " >/dev/null"), 1) << kind.str(1);
}

TEST_F(Run, PlugInsGetTheVerdictsThatTheyDeserve) {
  plan = scratch.write("plan.json", plan_text(24, R"(, "case_seconds": 1, "shrink_share": 0.002)"));
  const auto verdict = [&](const std::string& name) {
    out = scratch / name;
    return run("--detector " + plugin(name));
  };
  expect_ended(verdict("wrapped_builtin"), 0, {"\nholds: 0 trials with a defect, 0 undecided"});

  const auto example = expect_ended(
      verdict("example"), 0,
      {"neighbours no-shared-vertex",
       "steps the detector does not report a contact, as its contract allows (neighbours "
       "no-shared-vertex): without this contract these steps would be misses\n"});
  EXPECT_FALSE(contains(example.out, "in 0 steps the detector does not report")) << example.out;

  const auto alarm = expect_ended(verdict("always_collision"), 1, {"DEFECT no-spurious: "});
  // Hardly any is shrunk: the smallest meshes come first.
  const auto sizes = sizes_told(alarm.out);
  ASSERT_EQ(sizes.size(), 9u) << alarm.out;
  EXPECT_LT(sizes.front(), sizes.back()) << alarm.out;
  EXPECT_TRUE(std::is_sorted(sizes.begin(), sizes.end())) << alarm.out;

  expect_ended(verdict("fast_math"), 1);

  expect_ended(verdict("refuse"), 1, {"DEFECT total: refused"});

  expect_ended(verdict("exit"), 1, {"DEFECT total: crashed", "exited with code 0"});
}

TEST_F(Run, ACrashIsADefectAndTheRunGoesOn) {
  // On its 1000th step, so not in a second run of the same case.
  plan = scratch.write("plan.json", R"({"schema": "assay-campaign/1", "name": "long", "seconds": 60,
      "strata": [{"family": "closed-generic", "cases": 640}]})");
  const auto crash = expect_ended(run("--jobs 1 --detector " + plugin("crash")), 1,
                                  {"DEFECT total: crashed (flaky)", "killed by signal 6 (Aborted)",
                                   "its case alone gives another result: "});
  EXPECT_EQ(trials_of(out).size(), 640u);
  for (const auto& line : replay_lines(crash.out)) {
    EXPECT_TRUE(contains(line, "-original.json")) << line;
    EXPECT_EQ(run_assay(line).exit_code, 0) << line;
  }
}

TEST_F(Run, AHangIsUndecidedAndSoIsTheRun) {
  plan = scratch.write("plan.json", R"({"schema": "assay-campaign/1", "name": "slow", "seconds": 20,
                       "case_seconds": 0.1, "strata": [{"family": "broken", "cases": 3}]})");
  expect_ended(run("--detector " + plugin("hang")), 3,
               {"broken, constant answer: 3 without a verdict"});
}

TEST_F(Run, ABoundThatIsOutOfReachIsUndecided) {
  plan = scratch.write("plan.json",
                       R"({"schema": "assay-campaign/1", "name": "small", "seconds": 20,
          "strata": [{"family": "closed-generic", "cases": 8, "bound": 0.01}]})");
  expect_ended(run(), 3, {"is wanted\n", "next: "});
}

TEST_F(Run, TimeThatEndsEarlyIsIncompleteAndGoesOn) {
  plan =
      scratch.write("plan.json", plan_text(3000, R"(, "fault_cases": 200000, "fault_seeds": 1)"));
  const auto begin = std::chrono::steady_clock::now();
  const auto outcome = run("--time 1");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took.count(), 20);  // a loaded machine
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
  expect_says(outcome.out, {"\nincomplete: ", "planted faults", "next: run the same command"});
  const auto before = trials_of(out).size();
  EXPECT_LT(before, 6000u);
  expect_ended(run("--time 1.5"), 3);
  EXPECT_GT(trials_of(out).size(), before);
}

TEST_F(Run, WithoutItsWorkerOrItsCorpusItEndsWithALine) {
  // The program beside which neither stands.
  const std::string moved = scratch / "bin/assay";
  std::filesystem::create_directories(scratch / "bin");
  std::filesystem::copy_file(ASSAY_PROGRAM, moved);
  const auto line_of = [&](const std::string& variables) {
    EXPECT_EQ(exit_code_of(variables + moved + " run --campaign " + plan + " --out " + out + " >" +
                           (scratch / "text") + " 2>&1"),
              2);
    return read_text(scratch / "text");
  };
  EXPECT_TRUE(says(line_of("ASSAY_CORPUS=" ASSAY_SOURCE_DIR "/corpus "),
                   "assay: cannot start " + (scratch / "bin/assay-worker")));
  EXPECT_TRUE(contains(line_of(""), "assay: the shipped corpus is not at " +
                                        (scratch / "share/assay/corpus") +
                                        "; set ASSAY_CORPUS to its folder"));
  EXPECT_TRUE(contains(line_of("ASSAY_CORPUS=/nowhere "), "assay: ASSAY_CORPUS is /nowhere: "));
}

// If the system gives no more descriptors, some of the workers cannot be had. That says nothing of
// the harness, and with more descriptors the run goes on.
TEST_F(Run, FewDescriptorsEndItWithALine) {
  for (const std::string limit : {"10", "11", "12"})
    expect_line_under("prlimit --nofile=" + limit + " ");
  expect_ended(run("--jobs 8"), 0);
}

// A thread that the system does not give is done without; a worker cannot be. The system does not
// count the threads of root.
TEST_F(Run, FewThreadsEndItWithALine) {
  std::filesystem::permissions(scratch / "", std::filesystem::perms::all);
  for (const std::string limit : {"3", "4", "6"})
    expect_line_under(not_by_root() + "prlimit --nproc=" + limit + " ");
}

TEST_F(Run, BadInputIsOneLine) {
  expect_refused("run --campaign " + plan, "--out");
  expect_refused("run --campaign nowhere --out " + out, "nowhere");
  expect_refused("run --campaign " + scratch.write("bad.json", "{}") + " --out " + out,
                 "schema is missing");
  for (const auto& share : words("2/3 1/0 a/b 1 1/2/3 -1/3 1/1000001 ''"))
    expect_refused(run("--share=" + share), "--share");
  for (const auto& seed : words("-1 x 1.5 99999999999999999999"))
    expect_refused(run("--seed=" + seed), "--seed");
  expect_refused(run("--jobs 0"), "--jobs");
  expect_refused(run("--time 0"), "--time");
  expect_refused(run("--frobnicate"), "frobnicate");
  expect_refused(run("--detector " + plan), "not a detector plug-in");
  expect_refused(run("--detector " + scratch / "none.so"), "no such file");
  expect_refused(run("--detector " + plugin("wrong_abi")), "ABI version 99");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Run, AFolderWithoutPermission) {
  std::filesystem::create_directory(out);
  const auto all = std::filesystem::perms::all;
  for (const auto& open : {scratch / "", plan}) std::filesystem::permissions(open, all);
  std::filesystem::permissions(
      out, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec |
               std::filesystem::perms::others_read | std::filesystem::perms::others_exec);
  expect_refused(run("", not_by_root()), "ermission denied");
}

TEST_F(Run, ADamagedStore) {
  ASSERT_EQ(run().exit_code, 0);
  const std::string file = out + "/run.sqlite";
  const std::string whole = read_text(file);
  std::ofstream(file, std::ios::binary) << whole.substr(0, whole.size() / 2);
  expect_refused(run(), "run.sqlite: ");
  std::ofstream(file, std::ios::binary) << "this is no database, and long enough to tell";
  expect_refused(run(), "not a database");
  expect_refused("list failures " + out, "not a database");
}

TEST_F(Run, AFullDiskKeepsWhatIsStored) {
  plan = scratch.write("plan.json", plan_text(100));
  // No file may grow beyond 100 KiB.
  const auto full = expect_ended(run("--jobs 1", "trap '' XFSZ; ulimit -f 200; "), 2);
  EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1) << full.err;
  expect_says(full.err, {"run.sqlite: ", "run the same command again to go on"});
  const auto stored = trials_of(out);
  EXPECT_GT(stored.size(), 0u);
  EXPECT_LT(stored.size(), 200u);
  expect_ended(run(), 0);
  EXPECT_EQ(trials_of(out).size(), 200u);
}

}  // namespace
}  // namespace assay::tests
