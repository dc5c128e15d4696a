// `check` of a log: recorded answers are judged like the answers of a plug-in, a failure is stored
// as a small mesh, and lost parts of a log are reported.
#include <fmt/format.h>

#include "corpus/formats/sequences.h"
#include "corpus/scenes/scenes.h"
#include "detector/detector.h"
#include "tests/public_data.h"
#include "tests/recorded_log.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

// The steps of a report, without what differs from run to run, or that a log does not have.
nlohmann::json steps_in(const std::string& file) {
  nlohmann::json report = read_json(file);
  for (auto& step : report["steps"]) {
    step["diff"].erase("limit");
    if (step.contains("oracle")) step["oracle"].erase("time_ms");
  }
  return report["steps"];
}

class CheckLog : public testing::Test {
 protected:
  void SetUp() override {
    sequence_ = corpus::make_scene("crumpling-sphere", {400, 8, {}}).value();
    auto made = detector::Detector::create(sequence_.triangles, sequence_.frames.front(),
                                           detector::Options());
    auto& detector = made.value();
    for (std::size_t f = 0; f + 1 < sequence_.frames.size(); ++f)
      answers_.push_back(detector.step(sequence_.frames[f], sequence_.frames[f + 1]));
    collision_ = std::size_t(
        std::ranges::find(answers_, detector::Answer::collision, &detector::StepResult::answer) -
        answers_.begin());
    ASSERT_LT(collision_, answers_.size());
  }

  std::string record(const std::vector<detector::StepResult>& answers, bool ends = true,
                     const assay_description& description = all_claims_description()) const {
    const auto path = scratch_ / "steps.log";
    LogWriter log(path, sequence_.triangles, sequence_.frames.front(), description);
    for (std::size_t s = 0; s < answers.size(); ++s) {
      if (s == 2) log.note("two steps done");
      log.step(s == 0 ? sequence_.frames.data() : nullptr, sequence_.frames[s + 1], answers[s]);
    }
    if (ends) log.end();
    return path;
  }

  // The frames as files.
  std::string frames() const {
    std::string files;
    for (std::size_t f = 0; f < sequence_.frames.size(); ++f) {
      const auto file = scratch_ / fmt::format("{:03}.obj", f);
      EXPECT_TRUE(corpus::write_mesh(file, sequence_.frames[f], sequence_.triangles));
      files += " " + file;
    }
    return files;
  }

  // In one step with a contact, it says that there is none.
  std::vector<detector::StepResult> with_a_miss() const {
    auto wrong = answers_;
    wrong[collision_] = {};
    wrong[collision_].answer = detector::Answer::free;
    return wrong;
  }

  const Scratch scratch_;
  corpus::Sequence sequence_;
  std::vector<detector::StepResult> answers_;
  std::size_t collision_ = 0;
};

TEST_F(CheckLog, RightAnswersHold) {
  expect_ended(
      "check " + record(answers_), 0,
      {"recorded of recorded 1", "noted before step 3: two steps done", "all claims hold"});
}

// Frames with a table of answers need no recorder.
TEST_F(CheckLog, ATableOfAnswersIsJudgedBesideFrames) {
  std::string rows = "step,answer,time\n";
  for (std::size_t s = 0; s < answers_.size(); ++s) {
    const bool hits = answers_[s].answer == detector::Answer::collision;
    rows += hits ? fmt::format("{},collision,{}\n", s + 1, answers_[s].first.lo)
                 : fmt::format("{},free,\n", s + 1);
  }
  const auto check = [&](const std::string& table, const std::string& more = "") {
    return run_assay("check" + frames() + " --answers " + scratch_.write("t.csv", table) + more);
  };
  expect_ended(check(rows), 0, {"claims: free-sound, not-late"});
  auto wrong = rows;
  const auto row = wrong.find(fmt::format("\n{},collision", collision_ + 1));
  wrong.replace(row, wrong.find('\n', row + 1) - row, fmt::format("\n{},free,", collision_ + 1));
  const auto kept = scratch_ / "kept";
  expect_ended(check(wrong, " --keep " + kept), 1);
  const auto file = fmt::format("{}/step-{}/case.json", kept, collision_ + 1);
  EXPECT_EQ(run_assay("replay " + file).exit_code, 0) << "the built-in detector is right there";
  expect_ended(check(rows.substr(0, rows.find("\n3,") + 1)), 0,
               {"step 3: left out: the table has no row for this step"});
  for (const char* bad : {"", "x", "0,free,", "1,maybe,", "1,collision,2", "1,free,\n1,free,"})
    EXPECT_EQ(check(bad).exit_code, 2) << bad;
}

TEST_F(CheckLog, CheckKeepsWhatAPluginFailsOnShrunk) {
  const auto kept = scratch_ / "kept";
  expect_ended("check" + frames() + " --detector " + plugin("always_free") + " --keep " + kept, 1,
               {"reproduced; smallest: "});
  const auto file = fmt::format("{}/step-{}/smallest.json", kept, collision_ + 1);
  EXPECT_EQ(run_assay("replay " + file + " --detector " + plugin("always_free")).exit_code, 1);
}

// Whoever did not ask for it gets the line that does, and it runs as it is pasted.
TEST_F(CheckLog, CheckSaysHowToKeepWhatFails) {
  const auto words = "check" + frames() + " --detector '" + plugin("always_free") + "'";
  const auto checked = expect_ended(run_assay(words, "cd " + (scratch_ / "") + " && "), 1);
  const std::string mark = "\nnext: ";
  const auto at = checked.out.find(mark);
  ASSERT_NE(at, std::string::npos) << checked.out;
  const auto line = checked.out.substr(at + mark.size());
  EXPECT_NE(exit_code_of("cd " + (scratch_ / "") + " && " + line.substr(0, line.size() - 1) +
                         " >/dev/null"),
            0);
  const auto file = fmt::format("{}/kept/step-{}/smallest.json", scratch_ / "", collision_ + 1);
  EXPECT_TRUE(std::filesystem::exists(file)) << line;
  const auto held = expect_ended("check" + frames(), 0);
  EXPECT_FALSE(says(held.out, "next: ")) << held.out;
}

TEST_F(CheckLog, ReportsWhatCheckReportsOfTheSameSteps) {
  expect_ended("check" + frames() + " --detector " + plugin("wrapped_builtin") + " --json " +
                   (scratch_ / "check.json"),
               0);
  expect_ended("check " + record(answers_) + " --json " + (scratch_ / "log.json"), 0);
  EXPECT_TRUE(steps_in(scratch_ / "log.json") == steps_in(scratch_ / "check.json"));
}

TEST_F(CheckLog, AMissComesHomeAsTwoTrianglesAndTheirNeighbours) {
  const auto log = record(with_a_miss()), out = scratch_ / "out";
  const auto judged = expect_ended("check " + log + " --keep " + out, 1, {"broken: free-sound"});
  const auto step = fmt::format("step-{}", collision_ + 1);
  EXPECT_LT(read_json(out + "/" + step + "/case.json")["triangles"].size(), 60u);
  for (const auto* file : {"frame_0000.obj", "frame_0001.obj", "case.cpp", "case.svg"})
    EXPECT_TRUE(std::filesystem::exists(out + "/" + step + "/" + file)) << file;
  EXPECT_EQ(read_json(out + "/" + step + "/pair.json")["triangles"].size(), 2u);
  EXPECT_EQ(run_assay("check " + out + "/" + step + "/pair.json --fail-on-collision").exit_code, 5);
  // The part shows a contact by itself, and the whole step is one command away.
  EXPECT_EQ(run_assay("check " + out + "/" + step + "/case.json --fail-on-collision").exit_code, 5);
  const auto again = fmt::format("replay '{}#{}'", log, collision_ + 1);
  EXPECT_TRUE(says(judged.out, again));
  expect_ended(again, 1, {fmt::format("step {}: ", collision_ + 1)});
  EXPECT_EQ(run_assay(fmt::format("replay '{}#1'", log)).exit_code, 0);
  EXPECT_EQ(run_assay(fmt::format("replay '{}#99'", log)).exit_code, 2);
}

TEST_F(CheckLog, ThePageShowsVerdictClaimsAndKeptSteps) {
  const auto wrong = scratch_ / "a & b <i>.log", out = scratch_ / "out";
  std::filesystem::rename(record(with_a_miss()), wrong);
  expect_ended("check '" + wrong + "' --keep " + out, 1);
  const auto page = read_text(out + "/page.html");
  expect_says(
      page, {"<h1>defect: " + (scratch_ / "a &amp; b &lt;i&gt;.log"),
             fmt::format("<td>free-sound</td><td>broken</td><td>first in step {}", collision_ + 1),
             "<td>not-late</td><td>holds</td>", fmt::format("<h2>Step {}</h2>", collision_ + 1)});
  EXPECT_TRUE(contains(page, "<svg ")) << "the picture";
  EXPECT_TRUE(contains(page, fmt::format("#{}'</pre>", collision_ + 1))) << "the line to replay";
  EXPECT_FALSE(contains(page, "<script"));
  EXPECT_EQ(run_assay("check " + record(answers_) + " --keep " + out).exit_code, 0);
  EXPECT_TRUE(contains(read_text(out + "/page.html"), "<p>No step failed.</p>"));
}

TEST_F(CheckLog, ShrinkAndReplayTakeStepsOfLogsAndFrames) {
  const auto log = record(with_a_miss()), small = scratch_ / "small.json";
  const auto step = fmt::format(" '{}#{}'", log, collision_ + 1);
  const std::string detector = " --detector " + plugin("always_free");
  EXPECT_EQ(run_assay("replay" + step + detector).exit_code, 1);
  for (const auto& input : {step, frames()}) {
    expect_ended("shrink" + input + detector + " --time 20 --out " + small, 1);
    EXPECT_LE(read_json(small)["triangles"].size(), 3u);
  }
}

TEST_F(CheckLog, LinesPointsAndLooseVerticesAreCounted) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\nl 1 2\nl 2 3\np 4\n";
  const auto file = scratch_.write("a.obj", mesh);
  expect_ended("check " + file + " " + file, 0,
               {"4 vertices (1 in no triangle)", "not looked at: 2 lines (l), 1 point (p)"});
}

TEST_F(CheckLog, JUnitHasEachClaim) {
  const auto file = scratch_ / "junit.xml";
  EXPECT_EQ(run_assay("check " + record(with_a_miss()) + " --junit " + file).exit_code, 1);
  expect_says(read_text(file),
              {fmt::format("name=\"free-sound\">\n      <failure message=\"first in step {}\">",
                           collision_ + 1),
               "name=\"no-spurious\"/>"});
}

TEST_F(CheckLog, TenOfAKindAreKept) {
  const auto path = scratch_ / "same.log", out = scratch_ / "out";
  LogWriter log(path, sequence_.triangles, sequence_.frames.front());
  for (int s = 0; s < 12; ++s)
    log.step(&sequence_.frames[collision_], sequence_.frames[collision_ + 1],
             with_a_miss()[collision_]);
  log.end();
  expect_ended("check " + path + " --keep " + out, 1, {"not kept, because 10 failures of this"});
  EXPECT_TRUE(std::filesystem::exists(out + "/step-10"));
  EXPECT_FALSE(std::filesystem::exists(out + "/step-11"));
}

TEST_F(CheckLog, APluginOfTheSameCodeIsAskedAgain) {
  const auto log = record(with_a_miss()), out = scratch_ / "out";
  const auto same = run_assay("check " + log + " --keep " + out + " --detector " +
                              plugin("always_free") + " --shrink-time 20");
  EXPECT_TRUE(says(same.out, "reproduced; smallest: ")) << same.err;
  const auto smallest = fmt::format("{}/step-{}/smallest.json", out, collision_ + 1);
  EXPECT_LE(read_json(smallest)["triangles"].size(), 3u);
  expect_refused("check " + log + " --detector " + plugin("always_free"), "folder by --keep");
  std::filesystem::remove_all(out);
  const auto other =
      run_assay("check " + log + " --keep " + out + " --detector " + plugin("wrapped_builtin"));
  EXPECT_TRUE(says(other.out, "not reproduced"));
}

TEST_F(CheckLog, WhatIsLostIsSaid) {
  const auto log = record(answers_);
  const auto good = read_text(log);
  auto bad = good;
  bad[bad.size() / 2] ^= 1;
  expect_ended("check " + scratch_.write("bad.log", bad), 3,
               {fmt::format("to {}, from the first damage to the end of the log "
                            "(no record); steps read before the damage: 4\n",
                            good.size()),
                "undecided: a part of the input is lost"});
  expect_ended("check " + scratch_.write("cut.log", good.substr(0, good.size() - 99)), 0,
               {"the log was cut, or is being written"});
}

// The miss is in the part that is gone.
TEST_F(CheckLog, ALogWhoseRearIsDestroyedIsUndecided) {
  const auto good = read_text(record(with_a_miss()));
  const auto kept = good.size() / 5;
  for (const auto size : {good.size() - kept, std::size_t{5'000'000}}) {
    expect_ended(
        "check " + scratch_.write("rear.log", good.substr(0, kept) + std::string(size, '\0')), 3,
        {fmt::format("to {}, from the first damage to the end of the log (no record)", kept + size),
         "undecided: a part of the input is lost"});
  }
}

// Nothing is no success.
TEST_F(CheckLog, WhatLeavesNoStepToBeJudgedIsUndecided) {
  const auto none = scratch_ / "none.log";
  std::filesystem::rename(record({}), none);
  const auto log = record(answers_);
  for (const auto& words : {none, log + " --from 99", log + " --share 1e-9 --from 2"}) {
    SCOPED_TRACE(words);
    const auto junit = scratch_ / "none.xml";
    expect_ended("check " + words + " --junit " + junit, 3, {"undecided: no step was judged"});
    EXPECT_TRUE(says(read_text(junit), "name=\"total\">\n      <skipped"));
  }
  EXPECT_EQ(run_assay("check " + log + " --from 7").exit_code, 0);
}

// Where a step goes is not known; that is no fault of the detector, and no proof for it.
TEST_F(CheckLog, AStepThatIsNoneIsUndecided) {
  const auto path = scratch_ / "nan.log";
  LogWriter log(path, sequence_.triangles, sequence_.frames.front());
  auto broken = sequence_.frames[1];
  broken(0, 0) = std::nan("");
  log.step(sequence_.frames.data(), broken, answers_[0]);
  log.step(sequence_.frames.data(), sequence_.frames[1], answers_[0]);
  log.end();
  expect_ended("check " + path, 3, {"lost: step 1: a coordinate is not finite"});
}

TEST_F(CheckLog, AnAbsentAnswerHidesNoOtherRemark) {
  const auto path = scratch_ / "silent.log";
  LogWriter log(path, sequence_.triangles, sequence_.frames.front());
  assay_record_step_data silent = {};
  silent.x0 = silent.x1 = LogWriter::array(sequence_.frames.front());
  log.step(silent);
  log.step(sequence_.frames.data(), sequence_.frames[1], answers_[0]);
  log.end();
  const auto text = read_text(path);
  expect_ended("check " + scratch_.write("cut.log", text.substr(0, text.size() - 9)), 0,
               {"1 step without an answer", "the log was cut, or is being written"});
}

TEST_F(CheckLog, ALogIsNotOverwritten) {
  const auto log = record(answers_);
  for (const char* option : {" --json ", " --junit "}) {
    EXPECT_EQ(run_assay("check '" + log + "#1'" + option + log).exit_code, 2);
    EXPECT_EQ(run_assay("check " + log).exit_code, 0);
  }
}

TEST_F(CheckLog, SeveralLogsAreJudgedWhateverOneIs) {
  const auto out = scratch_ / "out", xml = scratch_ / "all.xml";
  const auto log = record(with_a_miss()), empty = scratch_.write("empty.log", "");
  expect_ended("check " + (scratch_ / "absent.log") + " " + log + " " + empty + " " + log +
                   " --keep " + out + " --junit " + xml,
               2);
  for (const char* folder : {"/2-steps.log", "/4-steps.log"})
    EXPECT_TRUE(std::filesystem::exists(out + folder)) << folder;
  const auto suites = read_text(xml);
  const auto problem = suites.find("<error message=");
  EXPECT_NE(problem, std::string::npos);
  EXPECT_NE(suites.find("<error message=", problem + 1), std::string::npos);
  // Of one log that cannot be read the file tells as much.
  const auto bytes = read_text(log), one = scratch_ / "one.xml";
  auto spoilt = bytes;
  spoilt[spoilt.find("begin")] = 'B';
  const auto damaged = scratch_.write("damaged.log", spoilt);
  expect_refused("check " + damaged + " --junit " + one, "its first record is damaged");
  EXPECT_TRUE(says(read_text(one), "<error message="));
  expect_refused("check " + scratch_.write("packed.log", "\x1f\x8b\b more") + "#1", "gunzip it");
  // No log is written over, and what each would refuse is refused once.
  expect_refused("check " + log + " " + log + " --junit " + log, log);
  EXPECT_EQ(read_text(log), bytes);
  expect_refused(
      "check " + log + " " + log + " --detector " + plugin("always_free") + " --junit " + xml,
      "name their folder by --keep");
}

// A share is the same in every run; what was killed goes on with a later step.
TEST_F(CheckLog, SomeOfTheStepsAreJudged) {
  const auto log = record(answers_);
  const auto judged = [&](const std::string& which) {
    const auto file = scratch_ / "part.json";
    expect_ended("check " + log + which + " --json " + file, 0);
    return steps_in(file);
  };
  const auto steps = judged(" --share 0.5");
  EXPECT_LT(steps.size(), answers_.size());
  EXPECT_GT(steps.size(), 0u);
  EXPECT_TRUE(judged(" --share 0.5") == steps);
  EXPECT_EQ(judged(" --from 5").size(), answers_.size() - 4);
}

TEST_F(CheckLog, FollowsALogUntilItEnds) {
  const auto path = scratch_ / "grows.log";
  LogWriter log(path, sequence_.triangles, sequence_.frames.front());
  Outcome judged;
  std::thread reader([&] { judged = run_assay("check " + path + " --follow"); });
  for (std::size_t s = 0; s < answers_.size(); ++s) {
    log.step(sequence_.frames.data() + s, sequence_.frames[s + 1], answers_[s]);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  log.end();
  reader.join();
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  EXPECT_TRUE(says(judged.out, fmt::format("{0} of {0} steps judged", answers_.size())));
}

TEST_F(CheckLog, WhatALogCannotShowIsNotJudged) {
  auto description = all_claims_description();
  description.claims |= ASSAY_CLAIM_DETERMINISTIC;
  expect_ended("check " + record(answers_, true, description), 0,
               {"not judged: deterministic, because a log holds each step once"});
  description.claims = ASSAY_CLAIM_DETERMINISTIC;
  EXPECT_EQ(run_assay("check " + record(answers_, true, description)).exit_code, 2);
}

std::size_t triangles_of_first_failure(const std::string& out) {
  std::set<std::filesystem::path> steps;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    if (entry.is_directory()) steps.insert(entry.path());
  }
  return steps.empty() ? 0 : read_json(*steps.begin() / "pair.json")["triangles"].size();
}

// A cloth that falls and folds; its detector drops some pairs of edges (tests/recording/cloth.cpp).
TEST(CheckLogOfSimulators, TheSlipOfAClothComesHomeAsTwoTriangles) {
  const Scratch scratch;
  const auto cloth = std::filesystem::path(ASSAY_PROGRAM).parent_path() / "record_cloth";
  const auto log = scratch / "cloth.log", out = scratch / "out";
  ASSERT_EQ(exit_code_of(cloth.string() + " " + log + " >/dev/null"), 0);
  expect_ended("check " + log + " --keep " + out, 0);
  ASSERT_EQ(exit_code_of(cloth.string() + " " + log + " slip >/dev/null"), 0);
  expect_ended("check " + log + " --keep " + out, 1,
               {"114 of 500 steps judged", "386 steps left out by the contract"});
  EXPECT_EQ(triangles_of_first_failure(out), 2u);
}

// A program in C that knows nothing of us but the header.
TEST(CheckLogOfSimulators, TheSlipOfACProgramComesHomeAsTwoTriangles) {
  const Scratch scratch;
  const auto source = scratch.write("simulator.c", R"(
#include "assay_record.h"
int main(int count, char** words) {
  const int32_t triangles[] = {0, 1, 2, 3, 4, 5};
  double x0[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 2, 2, 1, 3, 1, 2, 3}, x1[18];
  const assay_description mine = {.name = "mine", .version = "1", .claims = ASSAY_CLAIM_FREE_SOUND};
  const assay_record_settings settings = {.path = words[count - 1]};
  const assay_record_array rest = {.data = x0};
  const assay_result none = {.answer = ASSAY_FREE};
  assay_recorder log;
  int32_t code = assay_record_begin(&log, &settings, &mine, triangles, 2, rest, 6, NULL);
  for (int step = 0; step < 500; ++step) {
    memcpy(x1, x0, sizeof x1);
    for (int v = 3; v < 6; ++v) x1[3 * v + 2] -= 0.01; /* the second one falls through the first */
    const assay_record_step_data data = {.x0 = {x0, 0}, .x1 = {x1, 0}, .result = &none};
    if (code == ASSAY_OK) code = assay_record_step(&log, &data);
    memcpy(x0, x1, sizeof x0);
  }
  return code == ASSAY_OK ? assay_record_end(&log) : code;
}
)");
  const auto program = scratch / "simulator", log = scratch / "c.log", out = scratch / "out";
  const std::string built = "cc -std=c99 -Wall -Wextra -pedantic -Werror -I" ASSAY_SOURCE_DIR
                            "/detector/plugin " +
                            source + " -o " + program;
  ASSERT_EQ(exit_code_of(built + " && " + program + " " + log), 0);
  expect_ended("check " + log + " --keep " + out, 1);
  EXPECT_EQ(triangles_of_first_failure(out), 2u);
}

// Real meshes, from logs and from frames.
TEST(CheckLogOfPublicSequences, PublicLogsAreReportedAsTheirFrames) {
  if (!public_data()) GTEST_SKIP() << "no public data";
  const std::string data = public_data();
  const std::string cloth = data + "/ipc-toolkit/thick-cloth/t", dancer = data + "/codim-ipc-kick/";
  std::vector<std::vector<std::filesystem::path>> sequences = {{cloth + "0.ply", cloth + "1.ply"}};
  auto& frames = sequences.emplace_back();
  for (const auto& file : std::filesystem::directory_iterator(dancer)) {
    if (file.path().filename().string().starts_with("shell")) frames.push_back(file.path());
  }
  std::ranges::sort(frames);
  for (const auto& files : sequences) {
    const Scratch scratch;
    const auto sequence = corpus::read_sequence(files).value();
    auto made = detector::Detector::create(sequence.triangles, sequence.frames.front(),
                                           detector::Options());
    LogWriter log(scratch / "log", sequence.triangles, sequence.frames.front());
    std::string words;
    for (std::size_t f = 0; f < files.size(); ++f) {
      words += " " + files[f].string();
      if (f > 0) {
        log.step(&sequence.frames[f - 1], sequence.frames[f],
                 made.value().step(sequence.frames[f - 1], sequence.frames[f]));
      }
    }
    log.end();
    expect_ended("check " + (scratch / "log") + " --json " + (scratch / "a"), 0);
    expect_ended(
        "check" + words + " --detector " + plugin("wrapped_builtin") + " --json " + (scratch / "b"),
        0);
    EXPECT_TRUE(steps_in(scratch / "a") == steps_in(scratch / "b"));
  }
}

}  // namespace
}  // namespace assay::tests
