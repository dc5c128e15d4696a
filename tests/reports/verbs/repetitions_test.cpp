// Faults that show only on larger meshes: the oracle finds a plug-in that is wrong there, and a
// second run finds a plug-in whose answer depends on the number of threads. Lines that replay such
// a failure state this number.
#include <fmt/format.h>

#include "corpus/scenes/scenes.h"
#include "tests/public_data.h"
#include "tests/reports/json_schema.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

using Json = nlohmann::ordered_json;

class Repetitions : public testing::Test {
 protected:
  const Scratch scratch;
  const std::string out = scratch / "out";

  Outcome judge(const std::string& verb, const std::string& library, int triangles,
                const std::string& more = "", const std::string& prefix = "",
                const char* shrink_share = "0") const {
    const auto plan = scratch.write(
        "plan.json",
        plan_text(6, fmt::format(R"(, "shrink_share": {}, "policy": {{"repeated_triangles": {}}})",
                                 shrink_share, triangles)));
    return run_assay(verb + " --campaign " + plan + " --jobs 2 --out " + out + " --detector " +
                         plugin(library) + " " + more,
                     prefix);
  }
  Json predicate() const { return predicate_in(out); }
};

TEST_F(Repetitions, AnAnswerThatDependsOnThreadsOnLargeMeshesIsFound) {
  const auto made = expect_ended(judge("certify", "threads_matter", 1500), 1,
                                 {"DEFECT deterministic: two runs differ, large mesh"});
  EXPECT_TRUE(contains(made.out, "larger meshes on which runs differ") ||
              contains(made.out, "verdict: defect"))
      << made.out;
  const auto stated = predicate();
  EXPECT_EQ(stated["failed_gate"], "claims");
  ASSERT_EQ(stated["repeated"].size(), 3 * corpus::scenes().size() + 1);
  std::size_t broken = 0;
  for (const auto& row : stated["repeated"]) {
    if (!row["broken"].get<bool>()) continue;
    ++broken;
    EXPECT_EQ(row["threads"], Json::parse("[1, 2]")) << "the second run tells it";
    EXPECT_TRUE(contains(row["what"], "with 2 threads: collision, 0 pairs, first time [0, 0.5]"))
        << row;
    EXPECT_GT(row["triangles"], 1000);
  }
  EXPECT_GT(broken, 3u);
  ASSERT_EQ(stated["failures"].size(), 1u);
  EXPECT_TRUE(stated["failures"][0]["flaky"]);
  expect_certificate_schema(read_json(out + "/certificate.json"));
  EXPECT_EQ(run_assay("verify " + out + "/certificate.json").exit_code, 1);
  const auto page = scratch / "page.html";
  ASSERT_EQ(run_assay("report " + out + " --out " + page).exit_code, 0);
  EXPECT_TRUE(contains(read_text(page), "\"broken\":true"));
}

TEST_F(Repetitions, ADetectorThatIsWrongOnLargeMeshesAloneIsFound) {
  // Free above 210 triangles; every mesh of the trials is smaller.
  const std::string fault = "ASSAY_QUERY=free-above=210 ";
  const auto made = expect_ended(
      judge("run", "steps_and_query", 240, "--part steps --threads 3", fault, "0.02"), 1,
      {"DEFECT free-sound: answered free, ", ", large mesh (query alone), met once"});
  const auto lines = replay_lines(made.out);
  ASSERT_FALSE(lines.empty());
  EXPECT_TRUE(contains(lines[0], "-smallest.json")) << lines[0];
  expect_ended(run_assay(lines[0], fault), 1, {"DEFECT free-sound: answered free"});
}

// The seed draws half of the sizes between those of the trials and that of the plan.
TEST_F(Repetitions, ADetectorThatIsWrongInARangeOfSizesIsFound) {
  expect_ended(judge("run", "steps_and_query", 800, "--part steps",
                     "ASSAY_QUERY='free-above=210 up-to=700' "),
               1, {"DEFECT free-sound: answered free, "});
}

TEST_F(Repetitions, ADetectorThatIsWrongWhereManyPairsMeetIsFound) {
  // In no scene does the colliding step with the fewest contacts have so many.
  expect_ended(judge("run", "steps_and_query", 2000, "--part steps",
                     "ASSAY_QUERY='free-above=1900 from-pairs=2600' "),
               1, {"DEFECT free-sound: answered free, "});
}

// No other case has so many steps. What it claims besides is no matter.
TEST_F(Repetitions, ADetectorThatIsWrongAfterManyCommitsIsFound) {
  for (const std::string claims : {"", " claims=129"}) {
    std::filesystem::remove_all(out);
    const auto made = expect_ended(
        judge("run", "steps_and_query", 100, "--part steps",
              "ASSAY_QUERY='free-after-commits=100" + claims + "' "),
        1, {"DEFECT free-sound: answered free, ", ", large mesh", " wrong steps of larger meshes"});
    const auto lines = replay_lines(made.out);
    ASSERT_FALSE(lines.empty());
    expect_ended(run_assay(lines[0], "ASSAY_QUERY=free-after-commits=100 "), 1);
  }
}

TEST_F(Repetitions, TheSecondRunOfATrialAsksAgainAndWithOtherThreads) {
  const auto plan = scratch.write("many.json", plan_text(64, R"(, "shrink_share": 0)"));
  for (const std::string word : {"free-again", "free-threaded"}) {
    std::filesystem::remove_all(out);
    SCOPED_TRACE(word);
    expect_ended(run_assay("run --campaign " + plan + " --jobs 2 --out " + out +
                               " --part steps --detector " + plugin("steps_and_query"),
                           "ASSAY_QUERY=" + word + " "),
                 1, {"DEFECT deterministic: two runs differ"});
  }
}

TEST_F(Repetitions, TheCertificateSaysUpToWhichSizeEachClaimWasTried) {
  const auto made = expect_ended(judge("certify", "steps_and_query", 700, "--part steps"), 0,
                                 {"\nnot judged: the elementary query of this library\n"});
  const auto stated = predicate();
  EXPECT_EQ(stated["detector"]["unjudged_parts"], Json::array({"elementary query"}));
  EXPECT_EQ(stated["detector"]["query_claims"], Json::array());
  std::uint64_t most = 0;
  for (const auto& row : stated["repeated"]) {
    most = std::max(most, row["triangles"].get<std::uint64_t>());
    ASSERT_FALSE(row["judged"].empty()) << row;
    for (const auto& step : row["judged"]) EXPECT_TRUE(step["holds"]) << row;
  }
  ASSERT_EQ(stated["judged_up_to"].size(), 8u);
  // Not every scene collides, and so a claim of contacts may be tried on smaller ones alone.
  for (const auto& one : stated["judged_up_to"]) {
    EXPECT_GT(one["triangles"], 600) << one;
    const bool is_of_all = one["claim"] == "deterministic" || one["claim"] == "total";
    EXPECT_TRUE(!is_of_all || one["triangles"] == most) << one;
  }
  // "meshes of up to 690 triangles (free-sound, ...), of up to 722 (total, ...)"
  const std::string words = fmt::format(" of up to {} ", most);
  expect_says(made.out, {"\nclaims were tried on meshes of up to ", words});
  expect_says(read_text(out + "/summary.md"), {words, "not judged: its elementary query;"});
  EXPECT_EQ(run_assay("verify " + out + "/certificate.json").exit_code, 0);
}

// Who does not answer there is not wrong, and nothing is said of that size.
TEST_F(Repetitions, WhatWasLeftUndecidedWasNotJudged) {
  expect_ended(judge("certify", "steps_and_query", 1500, "--part steps",
                     "ASSAY_QUERY='undecided-above=1000 claims=129' "),
               0, {" judged, 0 wrong\n"});
  const auto stated = predicate();
  std::uint64_t most = 0;
  for (const auto& row : stated["repeated"]) {
    most = std::max(most, row["triangles"].get<std::uint64_t>());
    EXPECT_TRUE(row["triangles"] <= 1000 || row["judged"].empty()) << row;
  }
  EXPECT_GT(most, 1000u);
  ASSERT_EQ(stated["judged_up_to"].size(), 2u);
  for (const auto& one : stated["judged_up_to"]) EXPECT_LE(one["triangles"], 1000) << one;
}

TEST_F(Repetitions, OnSmallMeshesItIsNotAndWithoutTheFaultItHolds) {
  expect_ended(judge("run", "threads_matter", 400), 0,
               {" sequences of up to ", " steps; 0 sequences differ"});
  std::filesystem::remove_all(out);
  expect_ended(judge("certify", "threads_matter", 1500, "", "ASSAY_THREADS_MATTER=harmless "), 0);
  const auto stated = predicate();
  for (const auto& row : stated["repeated"]) {
    EXPECT_EQ(row["threads"], Json::parse("[1, 2, 4, 4]")) << row;
    EXPECT_EQ(row["runs"], 4);
    EXPECT_EQ(row["what"], "");
  }
}

TEST_F(Repetitions, TwoRunsThatDifferByThemselvesAreFoundToo) {
  expect_ended(judge("run", "threads_matter", 1500, "", "ASSAY_THREADS_MATTER=at-random "), 1,
               {"larger meshes on which runs differ"});
}

TEST_F(Repetitions, TheSameCommandRepeatsNothingTwice) {
  ASSERT_EQ(judge("run", "threads_matter", 400).exit_code, 0);
  expect_ended(judge("run", "threads_matter", 400), 0, {" steps; 0 sequences differ"});
}

TEST_F(Repetitions, WhoAsksForNoThreadsIsRunTwice) {
  expect_ended(judge("certify", "wrapped_builtin", 100), 0);
  for (const auto& row : predicate()["repeated"])
    EXPECT_EQ(row["threads"], Json::parse("[1, 1, 1]"));
}

TEST_F(Repetitions, AFolderWithoutThePublicSequencesIsRefused) {
  const auto refused = expect_ended(judge("run", "threads_matter", 400, "--data /nowhere"), 2);
  EXPECT_EQ(refused.err, "assay: /nowhere: this folder has none of the public sequences\n");
}

TEST_F(Repetitions, PublicSequencesAreRepeatedWhereTheyAreNamed) {
  const char* data = public_data();
  if (!data) GTEST_SKIP() << "no public data";
  expect_ended(judge("certify", "threads_matter", 400, std::string("--data ") + data), 1);
  const auto stated = predicate();
  // Three forms of each scene, the long sequence, and four public sequences as they are.
  EXPECT_EQ(stated["repeated"].size(), 3 * corpus::scenes().size() + 5);
  EXPECT_TRUE(contains(stated["replay"][0], " --data "));
  for (const auto& row : stated["repeated"])
    EXPECT_EQ(row["broken"],
              row["input"] == "rod-twist" || row["input"] == "kick" || row["input"] == "bunny-bent")
        << row;
}

TEST_F(Repetitions, LinesThatReplayTellTheThreads) {
  expect_ended(judge("certify", "always_free", 0, "--threads 3"), 1);
  const auto stated = predicate();
  EXPECT_EQ(stated["detector"]["threads"], 3);
  EXPECT_TRUE(contains(stated["replay"][0], "plugin_always_free.so --threads 3 --out AGAIN"))
      << stated["replay"];
  ASSERT_FALSE(stated["failures"].empty());
  for (const auto& failure : stated["failures"])
    EXPECT_TRUE(contains(failure["replay"], " --threads 3")) << failure["replay"];
  for (const char* file : {"/summary.md", "/junit.xml"})
    EXPECT_TRUE(contains(read_text(out + file), " --threads 3")) << file;
  // Another number is another run.
  expect_ended(judge("certify", "always_free", 0, "--threads 2"), 2);
}

}  // namespace
}  // namespace assay::tests
