// `assay bench --detector`: plug-ins whose answers are known, on small scenes, and the verb.
#include "corpus/scenes/scenes.h"
#include "reports/bench/workers/detector_suite.h"
#include "tests/reports/program.h"

namespace assay::reports {
namespace {

std::string library(const std::string& name) {
  return std::string(ASSAY_PLUGIN_DIR) + "/plugin_" + name + ".so";
}

struct Benched {
  BenchReport report;
  std::vector<ComparedSequence> sequences;

  std::uint64_t sum(std::uint64_t properties::StepErrors::*member) const {
    std::uint64_t all = 0;
    for (const auto& sequence : sequences) all += sequence.errors.*member;
    return all;
  }
};

Benched bench(const std::string& name, double seconds = 60) {
  const auto plugin =
      properties::Subject::open(ASSAY_WORKER, library(name), properties::DetectorPart::by_library,
                                {.seconds = seconds})
          .value();
  Benched out;
  out.report = detector_suite({"/nowhere", 0.01}, plugin, {}, &out.sequences);
  tests::expect_schema("bench", to_json(out.report, "version"));
  return out;
}

using properties::StepErrors;

TEST(DetectorBench, TheBuiltInAsAPluginHasNoErrorsAndItsOwnSpeed) {
  const auto done = bench("wrapped_builtin");
  const auto& report = done.report;
  EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
  ASSERT_EQ(done.sequences.size(), corpus::scenes().size());
  for (const auto& sequence : done.sequences) {
    ASSERT_TRUE(sequence.step && sequence.create) << sequence.name << ": " << sequence.ended;
    EXPECT_EQ(sequence.step->over.samples.size(), 2u);
    EXPECT_GT(sequence.step->plugin_ms.value, 0) << sequence.name;
    EXPECT_GT(sequence.create->built_in_ms.value, 0) << sequence.name;
    EXPECT_EQ(sequence.errors.steps, sequence.steps);
  }
  EXPECT_GT(done.sum(&StepErrors::contact), 5u);
  for (const auto member : {&StepErrors::unsafe, &StepErrors::false_alarms, &StepErrors::missing,
                            &StepErrors::spurious, &StepErrors::undecided})
    EXPECT_EQ(done.sum(member), 0u);
  // A public sequence that is not there is named.
  EXPECT_NE(text_of(report).find("/nowhere/ipc-toolkit/bunny.ply is not there"), std::string::npos);
}

TEST(DetectorBench, ErrorsStandBesideTimes) {
  const auto free = bench("always_free");
  const auto contacts = free.sum(&StepErrors::contact);
  EXPECT_EQ(free.sum(&StepErrors::missed), contacts);
  EXPECT_EQ(free.sum(&StepErrors::unsafe), contacts);
  EXPECT_GT(free.sum(&StepErrors::missing), contacts);
  EXPECT_EQ(free.sum(&StepErrors::false_alarms), 0u);
  EXPECT_FALSE(free.report.wrong_answers.empty());
  const auto alarms = bench("always_collision");
  EXPECT_EQ(alarms.sum(&StepErrors::false_alarms), alarms.sum(&StepErrors::steps) - contacts);
  EXPECT_EQ(alarms.sum(&StepErrors::missed), 0u);
  std::uint64_t early = 0;
  for (const auto& sequence : alarms.sequences) {
    early += sequence.errors.early.steps;
    EXPECT_TRUE(sequence.step) << "what is wrong is timed too";
  }
  EXPECT_GT(early, 0u);
}

TEST(DetectorBench, WhatTheContractLeavesOutIsCounted) {
  ::setenv("ASSAY_BY_CONTRACT", "start=free miss-at-start", 1);
  const auto done = bench("by_contract");
  const auto& report = done.report;
  ::unsetenv("ASSAY_BY_CONTRACT");
  EXPECT_TRUE(report.wrong_answers.empty()) << text_of(report);
  std::uint64_t left_out = 0;
  for (const auto& sequence : done.sequences) left_out += sequence.left_out;
  EXPECT_GT(left_out, 0u);
  EXPECT_NE(text_of(report).find("are left out by the contract"), std::string::npos);
}

TEST(DetectorBench, ARunThatEndsEarlyHasNoTimes) {
  const auto done = bench("hang", .2);  // enough to load it on a slow machine
  ASSERT_FALSE(done.sequences.empty());
  for (const auto& sequence : done.sequences) {
    EXPECT_FALSE(sequence.step) << sequence.name;
    EXPECT_TRUE(sequence.ended.starts_with("hung: ")) << sequence.ended;
    EXPECT_EQ(sequence.errors.undecided, sequence.steps);
  }
  EXPECT_EQ(to_json(done.report, "")["sequences"][0]["step"], nullptr);
}

TEST(DetectorBench, TheVerbWritesItsFiguresAndSaysWhatIsWrong) {
  const tests::Scratch scratch;
  const auto done =
      tests::run_assay("bench --quick --data /nowhere --detector " + library("always_free") +
                       " --json " + (scratch / "j") + " --csv " + (scratch / "c"));
  EXPECT_EQ(done.exit_code, 1) << done.err;
  EXPECT_NE(done.out.find("plug-in constant answer 1"), std::string::npos) << done.out;
  EXPECT_TRUE(says(done.out, "WRONG ANSWER: bend: constant answer breaks free-sound"));
  const auto json = nlohmann::json::parse(tests::read_text(scratch / "j"));
  EXPECT_EQ(json["detector"]["name"], "constant answer");
  ASSERT_EQ(json["sequences"].size(), corpus::scenes().size());
  EXPECT_EQ(json["sequences"][0]["step"]["over"]["samples"].size(), 2u);
  const auto csv = tests::read_text(scratch / "c");
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            1 + corpus::scenes().size());
}

TEST(DetectorBench, TheVerbRefusesInOneLine) {
  for (const std::string& arguments :
       {std::string("--detector /nowhere/x.so"), "--detector " + library("without_entry"),
        "--detector " + library("query_alone"), "--detector " + library("candidates_alone"),
        "--detector " + library("example") + " --suite sequences",
        "--detector " + library("example") + " --svg x.svg",
        "--detector " + library("example") + " --case-seconds 0",
        "--detector " + library("example") + " --threads 0"}) {
    const auto outcome = tests::run_assay("bench " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.out;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

}  // namespace
}  // namespace assay::reports
