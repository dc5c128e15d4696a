// If a call of a plug-in fails, its error text is reported, whichever call it was, and for every
// step. Also the output that a plug-in prints.
#include <fmt/format.h>
#include <unistd.h>

#include "properties/worker/isolation.h"
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/worker_process.h"
#include "tests/properties/worker/worker_cases.h"

namespace assay::properties {
namespace {

using detector::Answer, test::plugin_alone, test::small_case;

class ErrorTexts : public testing::Test {
 protected:
  explicit ErrorTexts() {
    c_ = small_case(41, 0);
    // Three steps that commit, forth and back.
    const auto first = c_.frames[0], second = c_.frames[1];
    c_.frames = {first, second, first, second};
  }
  ~ErrorTexts() override { ::unsetenv("ASSAY_SAYS_WHY"); }

  WorkerProcess worker(const char* call, const char* library = "says_why") {
    ::setenv("ASSAY_SAYS_WHY", call, 1);
    return {ASSAY_WORKER, test::plugin(library), {}};
  }
  corpus::Case c_;
};

TEST(Names, AreShortAndTheirOwn) {
  EXPECT_EQ(fault_of_name("mine"), "");
  EXPECT_EQ(fault_of_name(std::string(100, 'x')), "");
  EXPECT_EQ(fault_of_name(std::string(101, 'x')),
            "a name or version of 101 bytes, but 100 are allowed");
  for (const char* name : {"built-in", "Built in", "built-in 1"})
    EXPECT_EQ(fault_of_name(name), "the name of the built-in detector");
  for (const char* name : {" mine", "mine "})
    EXPECT_EQ(fault_of_name(name), "a name or version that begins or ends with a space");
}

TEST_F(ErrorTexts, OfDescribeAndCreate) {
  const auto description = worker("describe").describe();
  ASSERT_FALSE(description);
  EXPECT_TRUE(description.error().message.ends_with(": describe(): no describe today, 0"))
      << description.error().message;
  const auto run = worker("create").run(c_, plugin_alone).front();
  EXPECT_EQ(run.end, RunEnd::refused);
  EXPECT_EQ(run.explanation, "no create today, 0");
}

TEST_F(ErrorTexts, OfEveryStep) {
  struct Row {
    const char *call, *library, *returned;
  };
  for (const auto& [call, library, returned] :
       {Row{"evaluate", "says_why", ""},
        {"commit", "says_why_of_commit", "commit returned 3: "},
        {"candidates", "says_why", "candidates returned 3: "}}) {
    const auto run = worker(call, library).run(c_, plugin_alone).front();
    ASSERT_EQ(run.end, RunEnd::completed) << run.explanation;
    EXPECT_EQ(run.errors.size(), 3u) << call;
    for (std::size_t s = 0; s < 3; ++s) {
      EXPECT_EQ(run.steps[s].answer, Answer::error) << call;
      EXPECT_EQ(error_of(run, s),
                fmt::format("step {0}: {1}no {2} today, {0}", s + 1, returned, call));
    }
    EXPECT_EQ(run.explanation, error_of(run, 0));
  }
}

TEST_F(ErrorTexts, OfQueries) {
  const auto query = case_of_query({}, "query");
  auto asked = worker("query");
  for (int repetition = 0; repetition < 2; ++repetition) {
    const auto run = asked.run(query, plugin_alone).front();
    ASSERT_EQ(run.steps.size(), 1u) << run.explanation;
    EXPECT_EQ(run.steps[0].answer, Answer::error);
    EXPECT_EQ(run.explanation, "query returned 3: no query today, 0");
  }
  const auto said = worker("query-error").run(query, plugin_alone).front();
  EXPECT_EQ(said.explanation, "said by its result");
}

TEST_F(ErrorTexts, NoneWhereNothingFails) {
  const auto run = worker("").run(c_, plugin_alone).front();
  ASSERT_EQ(run.end, RunEnd::completed) << run.explanation;
  EXPECT_TRUE(run.errors.empty());
  EXPECT_EQ(run.explanation, "");
}

// What a plug-in prints: kept a case, its end alone where that is much, and harmless.

TEST(PrintedFile, KeepsTheEndFromAWholeLineOn) {
  auto printed = PrintedFile::make();
  ASSERT_TRUE(printed);
  const auto print = [&](const std::string& text) {
    EXPECT_EQ(::write(printed->descriptor(), text.data(), text.size()),
              static_cast<ssize_t>(text.size()));
  };
  print("short\n");
  EXPECT_EQ(printed->take(), "short");
  EXPECT_EQ(printed->take(), "");
  // A long text is cut while it comes, too.
  for (const int often : {1, 40}) {
    std::string text;
    for (int i = 0; i < 10'000; ++i) text += "line " + std::to_string(i) + "\n";
    for (int i = 0; i < often; ++i) {
      print(text);
      printed->keep_short();
    }
    print("the end\n");
    const auto kept = printed->take();
    EXPECT_TRUE(kept.starts_with("...\nline ")) << kept.substr(0, 40);
    EXPECT_TRUE(kept.ends_with("\nline 9999\nthe end")) << kept.substr(kept.size() - 40);
    EXPECT_LE(kept.size(), longest_printed + 4);
    EXPECT_GE(kept.size(), longest_printed - 20);
  }
}

TEST(PrintableLines, HoldNoEscapesAndNoEmptyEnd) {
  EXPECT_EQ(printable_lines("a\x1b[2J\r\n\nb\a\n\n"), "a?[2J\n\nb?");
  EXPECT_EQ(printable_lines(""), "");
  EXPECT_EQ(printable_lines("\n\n"), "");
}

class PrintedByPlugin : public testing::Test {
 protected:
  ~PrintedByPlugin() override { ::unsetenv("ASSAY_BY_CONTRACT"); }
  CaseRun run(const std::string& words, const corpus::Case& c, WorkerLimits limits = {}) {
    ::setenv("ASSAY_BY_CONTRACT", words.c_str(), 1);
    WorkerProcess worker(ASSAY_WORKER, test::plugin("by_contract"), limits);
    return worker.run(c, plugin_alone).front();
  }
  // Of a step, without the escape characters that were printed.
  static std::string lines(int count, Eigen::Index triangles) {
    std::string text;
    for (int i = 1; i <= count; ++i)
      text += (i > 1 ? "\nline " : "line ") + std::to_string(i) + " of ?[31m" +
              std::to_string(triangles) + " triangles";
    return text;
  }
};

TEST_F(PrintedByPlugin, EachCaseHasItsOwn) {
  ::setenv("ASSAY_BY_CONTRACT", "print=2", 1);
  WorkerProcess worker(ASSAY_WORKER, test::plugin("by_contract"));
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto c = small_case(41, i);
    const auto one = worker.run(c, plugin_alone).front();
    ASSERT_EQ(one.end, RunEnd::completed) << one.explanation;
    EXPECT_TRUE(one.output.starts_with(lines(2, c.triangles.rows()))) << one.output;
    // Two lines a step, and no more.
    const auto newlines = std::count(one.output.begin(), one.output.end(), '\n');
    EXPECT_EQ(newlines + 1, static_cast<std::ptrdiff_t>(2 * corpus::steps_of(c).size()));
  }
  EXPECT_EQ(worker.starts(), 1u);
}

TEST_F(PrintedByPlugin, AFloodLeavesItsEndAndDelaysNobody) {
  const auto c = small_case(41, 0);
  const auto one = run("print=200000", c);
  ASSERT_EQ(one.end, RunEnd::completed) << one.explanation;
  EXPECT_LE(one.output.size(), longest_printed + 4);
  EXPECT_TRUE(one.output.starts_with("...\n")) << one.output.substr(0, 40);
  EXPECT_TRUE(says(one.output, "line 200000 of "));
  // It is kept with limits alone, too.
  const auto limited = run("print=1", c, {.isolation = Isolation::limits});
  ASSERT_EQ(limited.end, RunEnd::completed) << limited.explanation;
  EXPECT_TRUE(limited.output.starts_with(lines(1, c.triangles.rows()))) << limited.output;
}

TEST_F(PrintedByPlugin, ACrashAndAHangKeepWhatWasSaidBefore) {
  auto c = small_case(41, 0);
  // A coordinate that is beyond the range makes it abort.
  const auto crashed = run("print=3 range=1e200:1e300 abort-outside", c);
  ASSERT_EQ(crashed.end, RunEnd::crashed) << crashed.explanation;
  EXPECT_EQ(crashed.output, lines(3, c.triangles.rows()));
  // Its first time is a double above 0, or it does not burn.
  for (std::uint64_t i = 0; i < 200; ++i) {
    c = small_case(41, i);
    const auto hung = run("print=3 burn=1000", c, {.seconds = .1});
    if (hung.end != RunEnd::hung) continue;
    EXPECT_TRUE(says(hung.output, "line 3 of "));
    return;
  }
  FAIL() << "no case hung";
}

}  // namespace
}  // namespace assay::properties
