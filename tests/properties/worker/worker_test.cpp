// The worker gives the same answers as a detector in this process, and whatever a detector does to
// its own process, the host continues.
#include "detector/detector.h"
#include "properties/judging/exam.h"
#include "properties/worker/messages.h"
#include "properties/worker/worker_process.h"
#include "tests/curated_cases.h"
#include "tests/problem_words.h"
#include "tests/properties/small_case.h"
#include "tests/properties/worker/worker_cases.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using detector::Answer, test::children, test::plugin, test::plugin_alone, test::small_case;

const std::vector<Configuration> four = {
    {"view-point", {detector::Culling::view_point}},
    {"view-line", {detector::Culling::view_line}},
    {"bvh", {detector::Culling::bvh}},
    {"first", {detector::Culling::view_point, detector::Start::verified, detector::Pairs::first}}};

// The script of a case is followed, its view given where the culling looks, and a mesh refused with
// the reason. In the script the state before a step is asked twice and the last step goes back.
TEST(Worker, AnswersAsThisProcessDoes) {
  std::vector<corpus::Case> cases;
  for (std::uint64_t i = 0; i < 300; ++i) {
    cases.push_back(small_case(31, i));
    if (i % 4 == 0)
      cases.back().script = {{0, 1, false}, {0, 1, false}, {0, 1, true}, {1, 0, true}};
  }
  cases.push_back(tests::curated_case("B1_one_vertex_own_nearest"));
  ASSERT_TRUE(cases.back().view && !cases.back().view->q1.empty());
  cases.push_back(small_case(31, 0));
  cases.back().triangles(0, 1) = cases.back().triangles(0, 0);
  WorkerProcess worker(ASSAY_WORKER, std::nullopt);
  std::size_t pairs = 0, refused = 0;
  for (const auto& c : cases) {
    const auto runs = worker.run(c, four);
    ASSERT_EQ(runs.size(), four.size());
    for (std::size_t k = 0; k < four.size(); ++k) {
      const auto& run = runs[k];
      ASSERT_TRUE(same_answers(run, run_case(c, four[k])))
          << c.id << " " << four[k].name << ": " << run.explanation;
      ASSERT_EQ(run.steps.size(), run.end == RunEnd::refused ? 0 : corpus::steps_of(c).size());
      for (const auto& step : run.steps) pairs += step.pairs.size();
      refused += run.end == RunEnd::refused && says(run.explanation, "triangle 0") ? 1 : 0;
    }
  }
  EXPECT_GT(pairs, 1000u);
  EXPECT_EQ(refused, four.size());
  EXPECT_EQ(worker.starts(), 1u);
}

TEST(Worker, ExpectedFactsStayWithTheHost) {
  auto c = small_case(31, 5);
  c.expected.answer = Answer::error;
  c.expected.steps.resize(1);
  RunRequest arrived;
  ASSERT_TRUE(decode(encode(std::uint64_t{7}, std::vector{c}, four), arrived));
  EXPECT_EQ(arrived.cases.at(0).frames, c.frames);
  EXPECT_EQ(arrived.cases.at(0).triangles, c.triangles);
  EXPECT_EQ(arrived.cases.at(0).expected.answer, std::nullopt);
  EXPECT_TRUE(arrived.cases.at(0).expected.steps.empty());
}

TEST(Worker, ACutMessageIsNoMessage) {
  const CaseRun run = run_case(small_case(31, 5), four[0]);
  const std::string whole = encode(run);
  CaseRun read;
  ASSERT_TRUE(decode(whole, read));
  EXPECT_TRUE(same_answers(run, read));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CaseRun cut;
    ASSERT_FALSE(decode(whole.substr(0, size), cut)) << size;
  }
  EXPECT_FALSE(decode(whole + '\0', read));
}

// A stated number is believed only as far as items come: a message of a megabyte that states a
// million results would take half a gigabyte before the first of them is looked at.
TEST(Worker, AStatedNumberAloneTakesNoMemory) {
  constexpr std::uint64_t million = 1'000'000;
  const auto bytes_of = [](std::uint64_t number) {
    std::string bytes;
    for (int shift = 0; shift < 64; shift += 8)
      bytes += static_cast<char>(static_cast<unsigned char>(number >> shift));
    return bytes;
  };
  const std::string end(1, '\0'), no_text = bytes_of(0);
  CaseRun read;
  // 0x7f is no answer, so the reading ends at the first result.
  EXPECT_FALSE(decode(end + no_text + bytes_of(million) + std::string(million, '\x7f'), read));
  EXPECT_LE(read.steps.capacity(), 2u);
  EXPECT_FALSE(decode(end + bytes_of(million * million) + "text", read));
  EXPECT_TRUE(read.explanation.empty());
}

// What sleeps is caught by the wall clock.
TEST(Worker, AHangEndsAtTheLimitAndTheOthersRun) {
  constexpr double limit = .1;
  WorkerProcess worker(ASSAY_WORKER, plugin("hang"), {.seconds = limit});
  const auto begin = std::chrono::steady_clock::now();
  const auto runs = worker.run(small_case(31, 0), std::vector<Configuration>(2, plugin_alone[0]));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  ASSERT_EQ(runs.size(), 2u);
  for (const auto& run : runs) {
    EXPECT_EQ(run.end, RunEnd::hung);
    EXPECT_EQ(run.explanation, "no answer in 0.1 s of processor time: asleep for 1 s");
    EXPECT_LT(run.processor_seconds, limit);
  }
  EXPECT_EQ(worker.starts(), 2u);
  EXPECT_GE(took.count(), 2 * 10 * limit);
  EXPECT_TRUE(children().empty());
}

// And with what keeps it.
TEST(Worker, EndsBeforeItsHostWhereMemoryIsShort) {
  std::optional<WorkerProcess> worker(std::in_place, ASSAY_WORKER, std::nullopt);
  ASSERT_EQ(worker->run(small_case(31, 0), plugin_alone)[0].end, RunEnd::completed);
  const auto of = [](const std::string& process) {
    int score = 0;
    std::ifstream("/proc/" + process + "/oom_score_adj") >> score;
    return score;
  };
  constexpr int first_of_all = 1000;
  EXPECT_EQ(of(std::to_string(children().at(0))), first_of_all);
  EXPECT_LT(of("self"), first_of_all);
  worker.reset();
  EXPECT_TRUE(children().empty());
}

TEST(Worker, MemoryEndsInUndecided) {
  // 10^6 triangles need more than the limit leaves.
  corpus::Case c;
  const std::int32_t n = 1'000'000;
  c.triangles.resize(n, 3);
  detector::Positions x = detector::Positions::Random(n + 2, 3);
  for (std::int32_t t = 0; t < n; ++t) c.triangles.row(t) << t, t + 1, t + 2;
  c.frames = {x, x};
  constexpr std::uint64_t limit = std::uint64_t{400} << 20;
  WorkerProcess worker(ASSAY_WORKER, std::nullopt, {.seconds = 60, .bytes = limit});
  const auto runs = worker.run(c, std::vector<Configuration>(2, four[2]));
  for (const auto& run : runs) {
    EXPECT_EQ(run.end, RunEnd::out_of_memory) << run.explanation;
    const auto verdict = judge_run(c, run, {}, {Claim::total}, {});
    EXPECT_EQ(verdict.outcome, Outcome::undecided);
    EXPECT_EQ(verdict.explanation, "out of memory");
  }
  EXPECT_EQ(worker.run(small_case(31, 0), plugin_alone)[0].end, RunEnd::completed);

  // Of a plug-in that says so, in a step.
  const auto step =
      WorkerProcess(ASSAY_WORKER, plugin("no_memory")).run(small_case(31, 0), plugin_alone)[0];
  const auto truth = judge_case(small_case(31, 0));
  const auto verdict = judge_run(small_case(31, 0), step, truth, {Claim::total}, {});
  EXPECT_EQ(verdict.outcome, Outcome::undecided);
  EXPECT_EQ(verdict.explanation, "step 1: out of memory");
}

TEST(Worker, DiesWithItsHost) {
  // A host that starts a worker on a hanging plug-in and is killed.
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t host = fork();
  if (host == 0) {
    WorkerProcess worker(ASSAY_WORKER, plugin("hang"), {.seconds = 60});
    const int started = worker.describe() ? children()[0] : 0;
    if (write(ready[1], &started, sizeof started) < 0) _exit(1);
    worker.run(small_case(31, 0), plugin_alone);
    _exit(0);
  }
  int worker = 0;
  ASSERT_EQ(read(ready[0], &worker, sizeof worker), static_cast<ssize_t>(sizeof worker));
  ASSERT_GT(worker, 0);
  ASSERT_TRUE(std::filesystem::exists("/proc/" + std::to_string(worker)));
  kill(host, SIGKILL);
  waitpid(host, nullptr, 0);
  EXPECT_TRUE(test::comes_true([&] {
    const auto stat = test::stat_of(worker);
    return stat.empty() || says(stat, ") Z ");
  }));
}

TEST(Worker, WithoutAProgramNothingIsRun) {
  WorkerProcess worker("/nowhere/assay-worker", std::nullopt);
  ASSERT_FALSE(worker.describe());
  EXPECT_TRUE(says(worker.describe().error(), "cannot start /nowhere/assay-worker"));
  const auto runs = worker.run(small_case(31, 0), four);
  ASSERT_EQ(runs.size(), 4u);
  for (const auto& run : runs) EXPECT_EQ(run.end, RunEnd::not_run);
  // Another program is no worker.
  const auto other = WorkerProcess("/bin/true", std::nullopt).describe();
  ASSERT_FALSE(other);
  EXPECT_TRUE(says(other.error(), "ended while it was loaded"));
}

TEST(Worker, HoldsNoOracle) {
  const tests::Scratch scratch;
  const auto output_of = [&](const std::string& command) {
    EXPECT_EQ(tests::exit_code_of(command + " > " + scratch / "output"), 0);
    return tests::read_text(scratch / "output");
  };
  const std::string libraries = output_of("ldd " ASSAY_WORKER);
  ASSERT_NE(libraries.find("libc.so"), std::string::npos) << libraries;
  for (const char* foreign : {"gmp", "mpfr", "mpfi", "CGAL", "libz.", "fmt"})
    EXPECT_FALSE(says(libraries, foreign));
  const std::string symbols = output_of("nm -C " ASSAY_WORKER);
  ASSERT_NE(symbols.find("assay::detector::Detector::evaluate"), std::string::npos);
  EXPECT_FALSE(says(symbols, "assay::oracle"));
  EXPECT_FALSE(says(symbols, "CGAL"));
}

}  // namespace
}  // namespace assay::properties
