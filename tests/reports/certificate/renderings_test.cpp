// JUnit and Markdown say the same as the certificate. They accept names of plug-ins and folders
// that are not valid text, or that contain markup.
#include "properties/words.h"
#include "reports/certificate/statement.h"
#include "reports/terminal/words.h"
#include "tests/properties/campaign/good_findings.h"
#include "tests/reports/certificate/issued_folder.h"

namespace assay::reports {
namespace {

using properties::RunFindings, properties::test::failure, properties::test::good_findings;
using tests::contains, tests::expect_says;

nlohmann::ordered_json judged(
    const RunFindings& findings,
    const properties::VerbRequest& asked = properties::asked_of_a_certificate()) {
  return make_predicate(findings, judge(findings, asked), findings.run.plan, "");
}

RunFindings with_a_defect() {
  auto findings = good_findings();
  findings.tally.strata["broken"].by_configuration[0] = {19, 1, 0, 0};
  findings.times_met["free-sound: missing"] = findings.claims_broken = 1;
  findings.failures = {failure("free-sound: missing")};
  return findings;
}

TEST(Junit, FailsWhereTheCertificateDoes) {
  const auto good = junit_text(judged(good_findings()));
  EXPECT_FALSE(contains(good, "<failure"));
  expect_says(good, {"<testsuite name=\"gates\" tests=\"6\" failures=\"0\" skipped=\"0\">"});
  const auto text = junit_text(judged(with_a_defect()));
  expect_says(
      text,
      {"name=\"broken, bvh\">\n      <failure message=\"19 of 20 trials hold, 1 defects",
       "name=\"free-sound: missing\">\n      <failure message=\"a &amp; b &lt; c (bvh), met once",
       "replay, in the folder of the run: assay replay ", "name=\"claims\">\n      <failure"});
  EXPECT_EQ(xml_escaped("<a b=\"c\">&\x01"), "&lt;a b=&quot;c&quot;&gt;&amp;?");
}

TEST(Junit, WhatWasNotJudgedIsSkipped) {
  const auto text = junit_text(judged(good_findings(), properties::asked_of_a_run()));
  expect_says(text, {"<testsuite name=\"gates\" tests=\"6\" failures=\"0\" skipped=\"2\">",
                     "name=\"speed\">\n      <skipped message=\"not judged: "});
}

TEST(Junit, OfAShareByItselfNoBoundIsWanted) {
  auto findings = good_findings();
  for (auto& stratum : findings.run.plan.strata) stratum.cases *= 2;
  findings.run.plan.strata[0].wanted_bound = 0.001;
  findings.parts = {{3, 2, "r"}};
  EXPECT_FALSE(contains(junit_text(judged(findings, properties::asked_of_a_run())),
                        "name=\"broken, bvh\">\n      <failure"));
  findings.parts = {{3, 1, "r"}};
  for (auto& stratum : findings.run.plan.strata) stratum.cases /= 2;
  EXPECT_TRUE(contains(junit_text(judged(findings, properties::asked_of_a_run())),
                       "name=\"broken, bvh\">\n      <failure"));
}

// One fault need not be found.
TEST(Junit, NothingFailsOfWhatIsCertified) {
  auto findings = good_findings();
  findings.run.plan.policy.power = 0.5;
  findings.evidence.faults[1].curated = false;
  const auto predicate = judged(findings);
  ASSERT_EQ(predicate["verdict"], "certified") << predicate["gates"];
  EXPECT_FALSE(contains(junit_text(predicate), "<failure")) << junit_text(predicate);
}

TEST(Summary, NamesVerdictGatesAndFailures) {
  auto findings = with_a_defect();
  findings.tally.strata["broken"].meshes = {1, 2, 3};
  findings.failures = {failure("a|b"), failure("c", "corpus/A1")};
  findings.times_met = {{"a|b", 1}};
  const auto text = summary_text(judged(findings));
  expect_says(
      text,
      {"## Assay: defect\n", "| claims | **fails** | a\\|b, met once; tiny:1:broken:3 (bvh)",
       "| complete | holds |", "| broken | 20 of 20 | 3 | 0 | 1 | 0 | ", "\n    assay replay ",
       "2 of 2 planted faults found: 0 by random cases, 2 by their curated case alone.",
       "**c** (bvh), met only in the corpus\n", "All 3 bounds together hold with confidence 95 %"});
}

TEST(Summary, ACertificateTellsItsDayAndARunThatOfItsBegin) {
  auto findings = good_findings();
  findings.evidence.issued.reset();
  const auto predicate = judged(findings);
  EXPECT_TRUE(contains(summary_text(predicate, "2026-01-31T12:00:00Z"), " Begun 2026-01-31T12:00"));
  EXPECT_FALSE(contains(summary_text(predicate), "Begun"));
  findings.evidence.issued = properties::Issuance{.out = "out", .at = "2026-02-01T12:00:00Z"};
  EXPECT_TRUE(contains(summary_text(judged(findings)), " Issued 2026-02-01T12:00:00Z."));
}

// A verdict says nothing of what was not judged, so the summary names both, and the contract.
TEST(Summary, NamesClaimsContractAndCampaign) {
  auto findings = good_findings();
  auto& detector = findings.run.detector;
  detector.built_in = false;
  detector.configurations = {{"plug-in", {"no-spurious", "total"}}};
  detector.contract.margin = 1e300;
  const auto text = summary_text(judged(findings));
  expect_says(text, {"built-in: claims total; not judged: no-spurious (",
                     "; contract margin 1e+300; ", "; campaign tiny, seed 1"});
}

// The largest of each, be it of a trial, of the corpus or of a mesh that was repeated.
TEST(Summary, NamesTheLargestThatWasTried) {
  auto findings = good_findings();
  findings.tally.counts.extremes = {8, 1, 0, 5, 1, 200};
  for (auto& [family, stratum] : findings.tally.strata)
    stratum.triangles = stratum.triangles_in_contact = 200;
  findings.tally.counts.measures.relation_trials = 1;
  findings.evidence.sources[0].extremes = {2, 14, 1, 2, 1, 12};
  findings.evidence.sources.push_back(
      {.source = properties::Source::repeated, .extremes = {1, 2, 0, 1, 812, 99}});
  const auto predicate = judged(findings);
  EXPECT_EQ(predicate["tried"].dump(),
            R"({"largest":{"steps_in_a_row":8,"valence":14,"bodies":1,"components":5,"pairs":812,)"
            R"("triangles":200},"relations":1})");
  const auto text = summary_text(predicate);
  EXPECT_TRUE(contains(text,
                       "of up to 200 triangles; largest tried: 8 steps between two starts, 14 "
                       "triangles at a vertex, 1 body, 5 components, 812 pairs in a step, 200 "
                       "triangles; relations: 1 case; contract "))
      << text;
  // Queries have no size.
  findings.run.plan.strata = {{"query-generic", 20, 0}};
  EXPECT_TRUE(judged(findings)["tried"].is_null());
  EXPECT_FALSE(contains(summary_text(judged(findings)), "largest tried"));
}

TEST(Summary, SaysWhoseProofOfPowerItIs) {
  auto findings = good_findings();
  EXPECT_FALSE(contains(summary_text(judged(findings)), "proof is taken"));
  findings.evidence.power = {{"smoke", "built-in", 7, "", "", "", ""}};
  const auto text = summary_text(judged(findings));
  EXPECT_TRUE(contains(text, "Their proof is taken from campaign smoke, seed 7")) << text;
}

TEST(Printable, IsUtf8WithoutControlCharacters) {
  const std::string unknown = "\xef\xbf\xbd";
  const std::pair<std::string, std::string> cases[] = {
      {"plain, gr\xc3\xbc\xc3\x9f, \xe2\x82\xac, \xf0\x9f\x90\xa2", ""},
      {"\x1b[31mred\x7f\n", "?[31mred??"},
      {"\xc2\x9b", "?"},
      {"a\xff", "a" + unknown},
      {"\xc3", unknown},                                            // cut
      {"\xc0\xaf", unknown + unknown},                              // too long a form
      {"\xed\xa0\x80", unknown + unknown + unknown},                // a surrogate
      {"\xf4\x90\x80\x80", unknown + unknown + unknown + unknown},  // above U+10FFFF
  };
  for (const auto& [text, expected] : cases)
    EXPECT_EQ(properties::printable(text), expected.empty() ? text : expected);
}

// All the work is done when the certificate is written: no name may end it then.
TEST(OddText, OfAPlugInAndAFolderIsReplacedAndVerifies) {
  const tests::Scratch scratch;
  const auto folder = scratch / "out";
  auto run = tests::RunToStore();
  run.request.detector.name = "bad \xff name";
  run.request.detector.built_in = false;
  run.request.detector.configurations = {{"bad \xfe", {}}};
  run.meet_canary(3).judge("closed-generic", 10, 'H').judge("broken", 10, 'D');
  run.fail("E1_free_membrane", "all-pairs: missing", "what \xfd");
  tests::store_and_issue(run, folder, {scratch / "\xff\xfe", "lib\xfc.so"});
  if (HasFatalFailure()) return;
  const auto text = tests::read_text(folder + "/certificate.json");
  EXPECT_TRUE(nlohmann::ordered_json::accept(text)) << "JSON is UTF-8";
  EXPECT_TRUE(contains(text, "bad \xef\xbf\xbd name"));
  for (const char* file : {"/junit.xml", "/summary.md"}) {
    const auto rendered = tests::read_text(folder + file);
    EXPECT_FALSE(contains(rendered, "\xff") || contains(rendered, "\xfe")) << file;
  }
  // The mesh is not written here: nothing else may be amiss.
  const auto verified = verify_certificate(folder + "/certificate.json");
  ASSERT_EQ(verified.differences.size(), 1u) << verified.differences[1];
  EXPECT_TRUE(contains(verified.differences[0], "failures/")) << verified.differences[0];
}

TEST(OddText, IsNoMarkupInTheSummary) {
  const tests::Scratch scratch;
  auto run = tests::good_run();
  run.request.detector.name = "<img src=x onerror=alert(1)> & | `code` [a](b) *b*";
  tests::store_and_issue(run, scratch / "out", {"out", ""});
  const auto summary = tests::read_text(scratch / "out/summary.md");
  EXPECT_FALSE(contains(summary, "<")) << summary;
  EXPECT_TRUE(contains(summary,
                       "&lt;img src=x onerror=alert(1)&gt; &amp; \\| \\`code\\` \\[a\\](b) "
                       "\\*b\\*"))
      << summary;
}

}  // namespace
}  // namespace assay::reports
