// `assay bench --detector`: plug-ins whose answers are known, on small scenes, and the verb on the
// command line.
#include "corpus/scenes/scenes.h"
#include "reports/bench/compared/comparison.h"
#include "tests/reports/program.h"

namespace assay::reports {
namespace {

using tests::plugin;

// What the JSON says of the plug-in, a row for each family.
struct Benched {
  BenchReport report;
  std::vector<nlohmann::json> rows;

  std::uint64_t sum(const std::string& error) const {
    std::uint64_t all = 0;
    for (const auto& row : rows) all += row["counts"][error].get<std::uint64_t>();
    return all;
  }
};

Benched bench(const std::string& name, double seconds = 60) {
  const auto subject =
      properties::Subject::open(ASSAY_WORKER, plugin(name), properties::DetectorPart::by_library,
                                {.seconds = seconds})
          .value();
  Benched out;
  out.report = detector_suite({"/nowhere", 0.01}, subject, {});
  const nlohmann::json json = to_json(out.report, "version");
  tests::expect_schema("bench", json);
  for (const auto& row : json["families"]) {
    if (row["subject"] != "built-in") out.rows.push_back(row);
  }
  return out;
}

TEST(DetectorBench, TheBuiltInAsAPluginHasNoErrorsAndItsOwnSpeed) {
  const auto done = bench("wrapped_builtin");
  const auto& report = done.report;
  EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
  ASSERT_EQ(done.rows.size(), corpus::scenes().size());
  for (const auto& row : done.rows) {
    ASSERT_FALSE(row["ms_a_step"].is_null()) << row.dump();
    EXPECT_EQ(row["time_over_reference"]["samples"].size(), 2u);
    EXPECT_GT(row["ms_a_step"]["median"], 0);
    EXPECT_GT(row["create_ms"]["median"], 0);
    EXPECT_EQ(row["counts"]["steps"], row["steps"]);
  }
  EXPECT_GT(done.sum("contact"), 5u);
  for (const auto* error : {"unsafe", "false_alarms", "missing", "spurious", "undecided"})
    EXPECT_EQ(done.sum(error), 0u) << error;
  // A public sequence that is not there is named.
  EXPECT_TRUE(says(text_of(report), "/nowhere/ipc-toolkit/bunny.ply is not there"));
}

TEST(DetectorBench, ErrorsStandBesideTimes) {
  const auto free = bench("always_free");
  const auto contacts = free.sum("contact");
  EXPECT_EQ(free.sum("missed"), contacts);
  EXPECT_EQ(free.sum("unsafe"), contacts);
  EXPECT_GT(free.sum("missing"), contacts);
  EXPECT_EQ(free.sum("false_alarms"), 0u);
  EXPECT_FALSE(free.report.wrong_answers.empty());
  const auto alarms = bench("always_collision");
  EXPECT_EQ(alarms.sum("false_alarms"), alarms.sum("steps") - contacts);
  EXPECT_EQ(alarms.sum("missed"), 0u);
  std::uint64_t early = 0;
  for (const auto& row : alarms.rows) {
    early += row["counts"]["early"]["steps"].get<std::uint64_t>();
    EXPECT_FALSE(row["ms_a_step"].is_null()) << "what is wrong is timed too";
  }
  EXPECT_GT(early, 0u);
}

TEST(DetectorBench, WhatTheContractLeavesOutIsCounted) {
  ::setenv("ASSAY_BY_CONTRACT", "start=free miss-at-start", 1);
  const auto done = bench("by_contract");
  const auto& report = done.report;
  ::unsetenv("ASSAY_BY_CONTRACT");
  EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
  EXPECT_GT(done.sum("left_out"), 0u);
  EXPECT_TRUE(says(text_of(report), "are left out by the contract"));
}

TEST(DetectorBench, ARunThatEndsEarlyHasNoTimes) {
  const auto done = bench("hang", .2);  // enough to load it on a slow machine
  ASSERT_FALSE(done.rows.empty());
  for (const auto& row : done.rows) {
    EXPECT_EQ(row["ms_a_step"], nullptr);
    const auto family = row["family"].get<std::string>();
    EXPECT_TRUE(row["first_end"].get<std::string>().starts_with(family + ": hung: ")) << family;
    EXPECT_EQ(row["counts"]["undecided"], row["counts"]["steps"]);
  }
}

TEST(DetectorBench, TheVerbWritesItsFiguresAndSaysWhatIsWrong) {
  const tests::Scratch scratch;
  tests::expect_ended(
      tests::run_assay("bench --quick --data /nowhere --detector " + plugin("always_free") +
                       " --json " + (scratch / "j") + " --csv " + (scratch / "c")),
      1, {"plug-in constant answer 1", "WRONG ANSWER: bend: constant answer breaks free-sound"});
  const auto json = nlohmann::json::parse(tests::read_text(scratch / "j"));
  EXPECT_EQ(json["subjects"][1]["subject"], "constant answer");
  ASSERT_EQ(json["families"].size(), 2 * corpus::scenes().size());
  const auto csv = tests::read_text(scratch / "c");
  EXPECT_GT(std::count(csv.begin(), csv.end(), '\n'), 100);
}

TEST(DetectorBench, TheVerbRefusesInOneLine) {
  for (const std::string& arguments :
       {std::string(), std::string("--suite nonsense"), std::string("--detector /nowhere/x.so"),
        "--detector " + plugin("without_entry"), "--detector " + plugin("query_alone"),
        "--detector " + plugin("candidates_alone"),
        "--detector " + plugin("example") + " --suite sequences",
        "--detector " + plugin("example") + " --case-seconds 0",
        "--detector " + plugin("example") + " --threads 0"}) {
    SCOPED_TRACE(arguments);
    tests::expect_one_line(tests::run_assay("bench " + arguments));
  }
}

}  // namespace
}  // namespace assay::reports
