// Each plug-in of tests/plugins runs in the worker over curated and random cases and gets the
// verdict that it deserves. The oracle stays right whatever plug-ins do.
#include <xmmintrin.h>

#include "properties/judging/exam.h"
#include "properties/worker/worker_process.h"
#include "tests/curated_cases.h"
#include "tests/properties/small_case.h"
#include "tests/reports/program.h"
#include "tests/sinking_corner.h"

namespace assay::properties {
namespace {

using detector::Answer, test::plugin, test::small_case;

const std::vector<Configuration> twice(2, {"plug-in", {}});

struct Judged {
  corpus::Case c;
  std::vector<oracle::StepJudgement> truth;
};

// Curated cases and random small steps, with the oracle's judgements made before any plug-in runs.
const std::vector<Judged>& cases() {
  static const std::vector<Judged> all = [] {
    auto found = tests::curated_cases();
    EXPECT_GE(found.size(), 50u);
    constexpr std::uint64_t small_steps = 1200, seed = 41;
    for (std::uint64_t i = 0; i < small_steps; ++i) found.push_back(small_case(seed, i));
    std::vector<Judged> judged;
    for (auto& c : found) {
      auto truth = judge_case(c);
      judged.push_back({std::move(c), std::move(truth)});
    }
    return judged;
  }();
  return all;
}

struct Tally {
  std::map<Outcome, std::size_t> outcomes;
  std::map<Claim, std::size_t> broken;
  std::size_t crashes = 0, left_out_misses = 0;
  std::uint64_t starts = 0;
  PluginDescription description;
};

Tally run_all(const std::string& name) {
  WorkerProcess worker(ASSAY_WORKER, plugin(name), {.seconds = 20});
  auto description = worker.describe();
  Tally tally;
  if (!description) {
    ADD_FAILURE() << description.error().message;
    return tally;
  }
  tally.description = description.value();
  const auto& [plugin_name, version, claims, contract, parts] = tally.description;
  for (const auto& [c, truth] : cases()) {
    const auto runs = worker.run(c, twice);
    const auto verdict = judge_run(c, runs[0], truth, claims, contract, &runs[1]);
    ++tally.outcomes[verdict.outcome];
    for (const auto claim : verdict.breaches) ++tally.broken[claim];
    for (const auto& run : runs) tally.crashes += run.end == RunEnd::crashed ? 1 : 0;
    tally.left_out_misses += verdict.left_out_misses;
  }
  tally.starts = worker.starts();
  std::printf("%s: %zu hold, %zu defects;", plugin_name.c_str(), tally.outcomes[Outcome::holds],
              tally.outcomes[Outcome::defect]);
  for (const auto& [claim, count] : tally.broken) std::printf(" %s %zu", name_of(claim), count);
  std::printf("\n");
  return tally;
}

// Wrapped, and as the two examples of the pages, whose contracts leave misses out.
TEST(Plugins, TheBuiltInAndTheExamplesHold) {
  std::map<std::string, Tally> tallies;
  for (const std::string name : {"wrapped_builtin", "example", "example_in_cpp"}) {
    tallies[name] = run_all(name);
    EXPECT_EQ(tallies[name].outcomes[Outcome::holds], cases().size()) << name;
  }
  const auto& built_in = tallies["wrapped_builtin"];
  auto claims = list_of(claims_from_outside);
  std::erase(claims, Claim::candidates);  // of a broad phase by itself
  EXPECT_EQ(list_of(built_in.description.claims), claims);
  EXPECT_EQ(built_in.starts, 1u);
  const auto& example = tallies["example"];
  EXPECT_EQ(example.description.contract.adjacency, Adjacency::no_shared_vertex);
  EXPECT_FALSE(example.description.claims.has(Claim::no_spurious));
  EXPECT_GT(example.left_out_misses, 100u);
  const auto& in_cpp = tallies["example_in_cpp"].description;
  EXPECT_TRUE(in_cpp.claims.has(Claim::free_sound) && in_cpp.claims.has(Claim::all_pairs));
  EXPECT_TRUE(in_cpp.contract.has_range());
}

void expect_unbroken(Tally& tally, std::initializer_list<Claim> claims) {
  for (const auto claim : claims) EXPECT_EQ(tally.broken[claim], 0u) << name_of(claim);
}

// One is unsound and nothing else, the other spurious and wrong in its times.
TEST(Plugins, AlwaysTheSameAnswerBreaksWhatItMust) {
  auto free = run_all("always_free");
  EXPECT_GT(free.broken[Claim::free_sound], 100u);
  EXPECT_EQ(free.broken[Claim::all_pairs], free.broken[Claim::free_sound]);
  expect_unbroken(free, {Claim::not_late, Claim::first_time, Claim::no_spurious,
                         Claim::deterministic, Claim::total});
  auto collision = run_all("always_collision");
  EXPECT_GT(collision.broken[Claim::no_spurious], 100u);
  EXPECT_GT(collision.broken[Claim::first_time], 100u);
  expect_unbroken(collision,
                  {Claim::free_sound, Claim::not_late, Claim::deterministic, Claim::total});
}

TEST(Plugins, ACrashBreaksTotalAndTheRunGoesOn) {
  auto tally = run_all("crash");
  // Two runs of every case in one worker; it dies on its 1000th step, again and again.
  ASSERT_GT(cases().size(), 1100u);
  EXPECT_GE(tally.crashes, 2u);
  EXPECT_EQ(tally.starts, tally.crashes + 1);
  EXPECT_EQ(tally.broken[Claim::total], tally.crashes);
  expect_unbroken(tally, {Claim::free_sound, Claim::not_late, Claim::first_time, Claim::first_pairs,
                          Claim::all_pairs, Claim::no_spurious});
  EXPECT_EQ(tally.outcomes[Outcome::holds] + tally.outcomes[Outcome::defect], cases().size());
}

// Vertex 3 crosses the triangle below it within the denormal numbers.
corpus::Case denormal_case() {
  constexpr double tiny = 64 * std::numeric_limits<double>::denorm_min();
  auto c = tests::sinking_corner(-tiny);
  c.frames[0](3, 2) = tiny;
  return c;
}

TEST(Plugins, FastMathIsFoundOutAndStaysInTheWorker) {
  const auto mode = _mm_getcsr();
  const auto before = judge_case(denormal_case())[0];
  ASSERT_EQ(before.answer, Answer::collision);
  ASSERT_EQ(before.first, (detector::TimeEnclosure{.5, .5}));

  auto tally = run_all("fast_math");
  EXPECT_GT(tally.outcomes[Outcome::defect], cases().size() / 20);
  EXPECT_GT(tally.broken[Claim::free_sound], 0u);

  WorkerProcess worker(ASSAY_WORKER, plugin("fast_math"));
  const auto c = denormal_case();
  const auto run = worker.run(c, {twice.data(), 1})[0];
  EXPECT_EQ(judge_run(c, run, judge_case(c), tally.description.claims, {}).outcome,
            Outcome::defect);
  EXPECT_EQ(_mm_getcsr() & 0x8040u, mode & 0x8040u);  // flush to zero, denormals are zero
  const auto after = judge_case(denormal_case())[0];
  EXPECT_EQ(after.answer, Answer::collision);
  EXPECT_EQ(after.first, before.first);
}

TEST(Plugins, WhatIsNoPlugInIsRefusedInOneLine) {
  const std::map<std::string, const char*> refused = {
      {plugin("nowhere"), "no such file"},
      {std::string(ASSAY_SOURCE_DIR) + "/README.md", "not a detector plug-in"},
      {plugin("without_entry"), "it exports no assay_detector()"},
      {plugin("wrong_abi"), "built for ABI version 99, this program accepts 1 to 3"}};
  for (const auto& [library, why] : refused) {
    WorkerProcess worker(ASSAY_WORKER, library);
    const auto description = worker.describe();
    ASSERT_FALSE(description) << library;
    const std::string& message = description.error().message;
    EXPECT_EQ(message.find(library), 0u) << message;
    EXPECT_TRUE(says(message, why));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Plugins, WhatBreaksTheRulesOfTheHeaderIsAnError) {
  const std::map<std::string, std::string> wrong = {
      {"no_such_triangle", "step 1: pair 0 names no two triangles"},
      {"no_interval", "step 1: its first time, [1, 0], is no interval in [0, 1]"},
      {"fail", "step 1: evaluate returned 3"}};
  const auto c = small_case(41, 0);
  for (const auto& [name, why] : wrong) {
    WorkerProcess worker(ASSAY_WORKER, plugin(name));
    const auto run = worker.run(c, {twice.data(), 1})[0];
    ASSERT_EQ(run.end, RunEnd::completed);
    EXPECT_EQ(run.steps[0].answer, Answer::error);
    EXPECT_EQ(run.explanation, why);
    EXPECT_EQ(judge_run(c, run, judge_case(c), {Claim::total}, {}).breaches,
              std::vector<Claim>{Claim::total});
    EXPECT_EQ(judge_run(c, run, judge_case(c), {}, {}).outcome, Outcome::error);
  }
  const auto refusal = WorkerProcess(ASSAY_WORKER, plugin("refuse")).run(c, twice)[0];
  EXPECT_EQ(refusal.end, RunEnd::refused);
  EXPECT_EQ(refusal.explanation, "too many triangles");
}

std::string text_of(const std::string& path) { return tests::read_text(ASSAY_SOURCE_DIR + path); }

TEST(Plugins, ThePageShowsTheExampleThatIsTested) {
  const std::string page = text_of("/detector/plugin/README.md");
  const std::string in_cpp = text_of("/tests/plugins/example_in_cpp.cpp");
  ASSERT_FALSE(in_cpp.empty());
  EXPECT_LE(std::count(in_cpp.begin(), in_cpp.end(), '\n'), 40);
  EXPECT_TRUE(says(page, "```cpp\n" + in_cpp + "```\n"));
}

// Its class to the end of describe(), and the line behind which one is missing.
TEST(Plugins, TenMinutesShowTheDetectorThatIsThere) {
  const std::string page = text_of("/reports/check/TEN_MINUTES.md");
  const std::string source = text_of("/tests/plugins/additive_ccd.cpp");
  const auto begin = source.find("struct AdditiveCcd {"),
             end = source.find("  static Result query");
  ASSERT_LT(begin, end);
  EXPECT_TRUE(says(page, source.substr(begin, end - begin)));
  EXPECT_NE(source.find("\n  const double u = share("), std::string::npos);
}

}  // namespace
}  // namespace assay::properties
