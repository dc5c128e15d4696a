// What a plug-in says of a call that failed is told, whichever call it was, and of every step.
#include "properties/worker/plugin/query_case.h"
#include "properties/worker/worker_process.h"
#include "tests/properties/worker/worker_cases.h"

namespace assay::properties {
namespace {

using detector::Answer, test::plugin_alone;

class ErrorTexts : public testing::Test {
 protected:
  explicit ErrorTexts() {
    c_ = test::small_case(41, 0);
    // Three steps that commit, forth and back.
    const auto first = c_.frames[0], second = c_.frames[1];
    c_.frames = {first, second, first, second};
    c_.script.clear();
    c_.view.reset();
    c_.ghosts.reset();
    c_.expected = {};
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
            "a name or version of 101 bytes, and 100 are the most");
  for (const char* name : {"built-in", "Built in", "built-in 1"})
    EXPECT_EQ(fault_of_name(name), "the name of the built-in detector");
  for (const char* name : {" mine", "mine "})
    EXPECT_EQ(fault_of_name(name), "a name or version that begins or ends with a space");
}

TEST_F(ErrorTexts, OfDescribe) {
  const auto description = worker("describe").describe();
  ASSERT_FALSE(description);
  EXPECT_TRUE(description.error().message.ends_with(": describe(): no describe today, 0"))
      << description.error().message;
}

TEST_F(ErrorTexts, OfCreate) {
  const auto run = worker("create").run(c_, plugin_alone).front();
  EXPECT_EQ(run.end, RunEnd::refused);
  EXPECT_EQ(run.explanation, "no create today, 0");
}

TEST_F(ErrorTexts, OfEveryStep) {
  const auto run = worker("evaluate").run(c_, plugin_alone).front();
  ASSERT_EQ(run.end, RunEnd::completed) << run.explanation;
  EXPECT_EQ(run.explanation, "step 1: no evaluate today, 1");
  ASSERT_EQ(run.errors.size(), 3u);
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_EQ(run.steps[s].answer, Answer::error);
    const auto number = std::to_string(s + 1);
    EXPECT_EQ(error_of(run, s), "step " + number + ": no evaluate today, " + number);
  }
}

TEST_F(ErrorTexts, OfCommit) {
  const auto run = worker("commit", "says_why_of_commit").run(c_, plugin_alone).front();
  ASSERT_EQ(run.end, RunEnd::completed) << run.explanation;
  EXPECT_EQ(error_of(run, 0), "step 1: commit returned 3: no commit today, 1");
  EXPECT_EQ(error_of(run, 1), "step 2: commit returned 3: no commit today, 2");
}

TEST_F(ErrorTexts, OfCandidates) {
  const auto run = worker("candidates").run(c_, plugin_alone).front();
  ASSERT_EQ(run.end, RunEnd::completed) << run.explanation;
  EXPECT_EQ(error_of(run, 2), "step 3: candidates returned 3: no candidates today, 3");
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

}  // namespace
}  // namespace assay::properties
