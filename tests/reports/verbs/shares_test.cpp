// `assay verify DIR... --out DIR`: shares of a campaign, whose certificates each say incomplete,
// are combined into the verdict on the whole campaign.
#include "tests/reports/certificate/issued_folder.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

class Shares : public testing::Test {
 protected:
  // An eighth of a campaign of 16 cases in each of two families, as a run of it leaves it.
  static RunToStore eighth(std::uint64_t seed) {
    RunToStore run;
    run.request.plan.strata = {{"closed-generic", 16, 0.9}, {"broken", 16, 0}};
    run.request.seed = seed;
    run.request.shares = 8;
    return run.meet_canary(3);
  }
  std::string store(const RunToStore& run, const std::string& name) const {
    const std::filesystem::path folder = scratch / name;
    store_and_issue(run, folder, {folder.string(), ""});
    for (const auto& failure : run.failures) {
      const auto file = folder / properties::failure_file(failure, true);
      std::filesystem::create_directory(file.parent_path());
      write_bytes(file, failure.smallest);
    }
    return folder.string() + " ";
  }
  std::string good(std::uint64_t seed) const {
    return store(eighth(seed).judge("closed-generic", 2, 'H').judge("broken", 2, 'H'),
                 "share" + std::to_string(seed));
  }
  std::string good(std::uint64_t first, std::uint64_t last) const {
    std::string folders;
    for (auto seed = first; seed <= last; ++seed) folders += good(seed);
    return folders;
  }
  Outcome judge(const std::string& folders) const {
    return run_assay("verify " + folders + "--out " + out);
  }
  bool has_a_store() const { return properties::stored_runs(out).has_value(); }
  const Scratch scratch;
  const std::string out = scratch / "all";
};

TEST_F(Shares, OfEightSeedsComeToTheWhole) {
  const auto folders = good(1, 8);
  expect_ended("verify " + scratch / "share3", 3);
  EXPECT_EQ(predicate_in(scratch / "share3")["verdict"], "incomplete");
  expect_ended(judge(folders), 0,
               {"verdict: holds; " + out + "/certificate.json\n", "seeds 1, 2, 3, 4, 5, 6, 7, 8"});
  const auto stated = predicate_in(out);
  EXPECT_EQ(stated["campaign"]["is_whole"], true);
  EXPECT_EQ(stated["strata"][1]["trials"], 16);
  EXPECT_EQ(stated["strata"][1]["bounds"][0]["holds"], 16);
  // Each part by the digest that its own certificate states.
  ASSERT_EQ(stated["campaign"]["parts"].size(), 8u);
  for (const auto& part : stated["campaign"]["parts"]) {
    const auto seed = std::to_string(part["seed"].get<int>());
    EXPECT_EQ(part["share"], "1/8");
    EXPECT_EQ(part["rows"], predicate_in(scratch / ("share" + seed))["digests"]["rows"]) << seed;
  }
  EXPECT_EQ(run_assay("verify " + out).exit_code, 0);
  // It depends on the runs alone, and what it was computed from is part of a larger sum.
  const auto certificate = read_text(out + "/certificate.json");
  EXPECT_EQ(judge(folders).exit_code, 0);
  EXPECT_EQ(read_text(out + "/certificate.json"), certificate);
  expect_ended("verify " + out + " " + good(9) + "--out " + scratch / "more", 0);
  EXPECT_EQ(predicate_in(scratch / "more")["strata"][1]["trials"], 18);
}

TEST_F(Shares, OfWhichOneIsMissingAreIncomplete) {
  expect_ended(judge(good(1, 7)), 3,
               {"complete   FAILS\n  the shares make no whole "
                "campaign: 1/8 under seed 1, "});
  EXPECT_EQ(predicate_in(out)["verdict"], "incomplete");
  // A share that was not judged to its end.
  const auto half =
      store(eighth(8).judge("closed-generic", 2, 'H').judge("broken", 1, 'H'), "half");
  expect_ended(judge(good(1, 7) + half), 3, {"\n  broken: 15 of 16 trials\n"});
}

// Their indices leave the same remainder, and none is one of those that are run twice.
TEST_F(Shares, OfSeedsWithOneRemainderAreIncomplete) {
  std::string folders;
  for (std::uint64_t seed = 1; seed <= 57; seed += 8) folders += good(seed);
  expect_ended(judge(folders), 3, {"; shares 1/N need N consecutive seeds\n"});
}

TEST_F(Shares, OfOneSeedDoNotCountTwice) {
  std::filesystem::copy(scratch / "share2", scratch / "copy",
                        (good(1, 2), std::filesystem::copy_options::recursive));
  const auto twice = expect_ended(
      judge(scratch / "share1" + (" " + scratch / "share2") + " " + (scratch / "copy") + " "), 2);
  expect_says(twice.err, {"share2/run.sqlite and ", "copy/run.sqlite: both runs have seed 2, "});
  EXPECT_FALSE(has_a_store());
}

TEST_F(Shares, OfWhichOneHasADefectAreADefect) {
  auto run = eighth(8).judge("closed-generic", 2, 'H').judge("broken", 1, 'H');
  run.judge("broken", 1, 'D').fail("B1_one_vertex_own_nearest", "all-pairs: missing pair", "lost");
  expect_ended(judge(good(1, 7) + store(run, "share8")), 1, {"verdict: defect; "});
  const auto stated = predicate_in(out);
  ASSERT_EQ(stated["failures"].size(), 1u);
  EXPECT_TRUE(
      std::filesystem::exists(out + "/" + stated["failures"][0]["file"].get<std::string>()));
  EXPECT_EQ(run_assay("verify " + out).exit_code, 1);
  EXPECT_TRUE(contains(run_assay("list failures " + out).out, "DEFECT all-pairs: missing pair"));
}

// A failure of the corpus has one id in all shares, and perhaps another smallest mesh in each.
TEST_F(Shares, WhoseFailuresHaveOneNameKeepTheSmallestMesh) {
  std::string folders;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    auto run = eighth(seed).judge("closed-generic", 2, 'H').judge("broken", 2, 'D');
    run.fail(seed == 1 ? "A1_winding2_allpositive" : "B1_one_vertex_own_nearest",
             "all-pairs: missing pair", "lost");
    run.failures[0].source = properties::Source::corpus;
    run.failures[0].case_id = "one";
    folders += store(run, "share" + std::to_string(seed));
  }
  expect_ended(judge(folders), 1);
  EXPECT_EQ(run_assay("verify " + out).exit_code, 1);
  EXPECT_FALSE(contains(run_assay("verify " + out).out, "NOT VERIFIED"));
}

TEST_F(Shares, ThatDoNotBelongTogetherAreRefused) {
  const auto first = good(1);
  auto other = eighth(2);
  other.request.plan.case_seconds = 7;
  expect_problem(judge(first + store(other, "plan")),
                 "does not go together with the runs before: campaign/case_seconds ");
  EXPECT_FALSE(has_a_store());
  other = eighth(2);
  other.request.detector.configurations.pop_back();
  EXPECT_EQ(judge(first + store(other, "detector")).exit_code, 2);
  other = eighth(2);
  other.request.worker = "/bin/true";
  const auto builds = judge(first + store(other, "build"));
  EXPECT_TRUE(contains(builds.err, "another build of assay")) << builds.err;
  EXPECT_FALSE(has_a_store());
  // What is refused leaves the sum that it was to join.
  ASSERT_EQ(judge(first + good(3)).exit_code, 3);
  EXPECT_EQ(judge(out + " " + (scratch / "build") + " ").exit_code, 2);
  EXPECT_EQ(properties::stored_runs(out).value().size(), 2u);
  EXPECT_EQ(run_assay("verify " + out).exit_code, 3);
  // No run goes on there, which would be judged with them.
  for (const std::string verb : {"run", "certify"})
    expect_problem(run_assay(verb + " --campaign smoke --out " + out),
                   "seed-1.sqlite: belongs to another run");
  std::filesystem::remove_all(out);
  // A folder with another sum in it.
  ASSERT_EQ(judge(first).exit_code, 3);
  expect_problem(judge(good(2)), "seed-1.sqlite: belongs to another run");
}

// A share whose trials were changed does not verify, and nothing is made of it.
TEST_F(Shares, ThatDoNotVerifyAreNotCounted) {
  const auto folders = good(1, 2);
  properties::Database(scratch / "share2/run.sqlite", properties::Database::Mode::write)
      .run("DELETE FROM ledger WHERE key='tiny:2:broken:2'");
  expect_ended(judge(folders), 1, {"NOT VERIFIED: "});
  EXPECT_FALSE(has_a_store());
}

}  // namespace
}  // namespace assay::tests
