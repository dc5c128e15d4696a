// `assay report` on the command line.
#include "tests/reports/certificate/issued_folder.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

class Report : public testing::Test {
 protected:
  std::string tiny(const std::string& name, const std::string& explanation = "x") const {
    return RunToStore()
        .judge("closed-generic", 3, 'D')
        .fail("E1_free_membrane", "all-pairs: missing", explanation)
        .store(scratch / name);
  }
  const Scratch scratch;
};

TEST_F(Report, OnePageOfTwoRunsAndNothingElse) {
  const auto page = scratch / "page.html";
  const auto outcome = expect_ended("report " + tiny("a") + " " + tiny("b") + " --out " + page, 0);
  EXPECT_EQ(outcome.err, "");
  expect_says(outcome.out, {"a: defect", "page " + page});
  const auto text = read_text(page);
  EXPECT_TRUE(text.starts_with("<!doctype html>"));
  EXPECT_EQ(count_of(text, "\"signature\":\"all-pairs: missing\""), 2u);
  const auto again = scratch / "again.html";
  run_assay("report " + (scratch / "a") + " " + (scratch / "b") + " --out " + again);
  EXPECT_EQ(read_text(again), text) << "same input, same bytes";
}

TEST_F(Report, WhatAFailureSaysStaysText) {
  const auto plain = scratch / "plain.html", hostile = scratch / "hostile.html";
  run_assay("report " + tiny("plain") + " --out " + plain);
  run_assay("report " + tiny("hostile", "</script><script>alert(1)</script>") + " --out " +
            hostile);
  EXPECT_EQ(count_of(read_text(hostile), "</script"), count_of(read_text(plain), "</script"));
  EXPECT_EQ(count_of(read_text(hostile), "alert(1)"), 1u);
}

// A certificate is believed where it verifies, and only there.
TEST_F(Report, ACertificateOfAnotherRunIsNotBelieved) {
  const auto good = scratch / "good", bad = tiny("bad"), page = scratch / "page.html";
  store_and_issue(good_run(), good, {good, ""});
  ASSERT_EQ(run_assay("report " + good + " --out " + page).exit_code, 0);
  EXPECT_TRUE(contains(read_text(page), R"("verdict":"holds","why":"no gate fails")"));
  std::filesystem::copy_file(good + "/certificate.json", bad + "/certificate.json");
  expect_ended("report " + bad + " --out " + page, 0,
               {"bad: unverified; the certificate does not verify: "});
  const auto text = read_text(page);
  EXPECT_TRUE(contains(text, R"("verdict":"unverified","why":"the certificate does not verify: )"));
  EXPECT_FALSE(contains(text, R"("verdict":"holds")")) << "nor in what the page is told besides";
}

TEST_F(Report, WrongFoldersAndPlacesAreRefusedInOneLine) {
  const auto page = scratch / "page.html";
  expect_refused("report " + (scratch / "nowhere") + " --out " + page, "nowhere");
  std::filesystem::create_directory(scratch / "empty");
  expect_refused("report " + (scratch / "empty") + " --out " + page, "no run is stored here");
  expect_refused("report " + tiny("a"), "--out");
  expect_refused("report --out " + page, "DIR is required");
  expect_refused("report " + tiny("a") + " " + (scratch / "empty") + " --out " + page,
                 "no run is stored here");
  EXPECT_FALSE(std::filesystem::exists(page)) << "a page of some of the runs is none";
}

TEST_F(Report, ARunThatFailsLeavesPicturesAndItsReplayLineOnThePage) {
  const auto plan = scratch.write("plan.json", plan_text(12));
  const auto out = scratch / "out", page = scratch / "page.html";
  const auto run = expect_ended(
      "run --campaign " + plan + " --detector " + plugin("always_free") + " --out " + out, 1);
  ASSERT_TRUE(contains(run.out, ".svg")) << run.out;
  const auto listed = run_assay("list failures " + out).out;
  std::size_t pictures = 0;
  for (const auto& file : std::filesystem::directory_iterator(out + "/failures")) {
    if (file.path().extension() != ".svg") continue;
    ++pictures;
    EXPECT_TRUE(read_text(file.path()).starts_with("<svg"));
    EXPECT_TRUE(contains(listed, file.path())) << file.path();
  }
  EXPECT_EQ(pictures, signatures_of(out).size());
  EXPECT_EQ(run_assay("report " + out + " --out " + page).exit_code, 0);
  const auto text = read_text(page);
  const auto lines = replay_lines(listed);
  ASSERT_FALSE(lines.empty());
  // The page goes to readers of other machines: its lines are for the folder of the run.
  for (auto line : lines) {
    for (const auto& [place, told] :
         {std::pair(out + "/", std::string()),
          std::pair(std::string(ASSAY_PLUGIN_DIR) + "/", told_plugins(out))}) {
      ASSERT_TRUE(contains(line, place)) << line;
      line.replace(line.find(place), place.size(), told);
    }
    EXPECT_TRUE(contains(text, "assay " + line)) << line;
  }
  EXPECT_FALSE(contains(text, scratch / ""));
}

}  // namespace
}  // namespace assay::tests
