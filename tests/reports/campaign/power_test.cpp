// `--power DIR`: the proof that planted faults are found, taken from another run of this build.
#include "properties/campaign/gates/gates.h"
#include "tests/reports/campaign/power_fixture.h"

namespace assay::tests {
namespace {

class Power : public PowerFixture {
 protected:
  const std::string plan = scratch.write("plan.json", faults_text("mine", 20, 1));
  const std::string out = scratch / "out", store = out + "/run.sqlite";
  Outcome run(const std::string& folder, const std::string& more) const {
    return run_assay("run --campaign " + plan + " --out " + folder + library + " " + more);
  }
};

TEST_F(Power, OfAnotherRunIsCopiedToldAndJudged) {
  const auto made = run(out, with_proof);
  ASSERT_EQ(made.exit_code, 0) << made.out << made.err;
  EXPECT_TRUE(says(made.out,
                   "; planted faults as campaign proof, seed 7, of this build found "
                   "them; "));
  const auto proved = rows_of(proof_folder() + "/run.sqlite", "fault");
  EXPECT_TRUE(
      contains(made.out, " by their curated case alone; campaign proof, seed 7, of this build\n"))
      << made.out;
  EXPECT_TRUE(
      contains(read_text(out + "/summary.md"),
               " by their curated case alone. Their proof is taken from campaign proof, seed 7, "
               "of the same build.\n"));

  // Nothing was planted here: all rows are those of the proof.
  const auto taken = rows_of(store, "fault");
  ASSERT_GT(taken.size(), 100u);
  ASSERT_EQ(taken.size(), proved.size());
  for (std::size_t i = 0; i < taken.size(); ++i) {
    EXPECT_EQ(taken[i].key, proved[i].key);
    EXPECT_EQ(taken[i].fields, proved[i].fields);
  }
  const auto sources = rows_of(store, "power");
  ASSERT_EQ(sources.size(), 1u);
  const auto findings = properties::read_findings(proof_folder());
  ASSERT_TRUE(findings) << findings.error().message;
  EXPECT_EQ(Json::parse(sources[0].fields)["rows"], findings.value().rows);

  // The gates look at these rows.
  const auto hidden = hide_a_fault(store);
  const auto judged = judge(properties::read_findings(out).value());
  EXPECT_EQ(judged.of(properties::Gate::harness).reasons,
            std::vector<std::string>{"planted fault " + hidden + " was not found"});
  // And the same command copies them again.
  EXPECT_EQ(run(out, with_proof).exit_code, 0);
  const auto again = rows_of(store, "fault");
  ASSERT_EQ(again.size(), taken.size());
  for (std::size_t i = 0; i < taken.size(); ++i) EXPECT_EQ(again[i].fields, taken[i].fields);
}

// With a limit of time, too: what was left over goes on with the same command.
TEST_F(Power, ACertificateNamesItAndIsVerified) {
  const auto long_plan = scratch.write("plan.json", faults_text("mine", 20, 1, 1200));
  const auto certify = [&](const std::string& more) {
    return run_assay("certify --jobs 2 --campaign " + long_plan + " --out " + out + library +
                     with_proof + more);
  };
  const auto cut = certify(" --time 1");
  EXPECT_EQ(cut.exit_code, 3) << cut.out << cut.err;
  EXPECT_TRUE(contains(cut.out, "\ncomplete   FAILS\n  closed-generic: ")) << cut.out;
  EXPECT_TRUE(contains(cut.out, "\nverdict: incomplete in ")) << cut.out;
  const std::string certificate = out + "/certificate.json";
  EXPECT_EQ(Json::parse(read_text(certificate))["predicate"]["verdict"], "incomplete");
  const auto before = trials_of(out);
  EXPECT_GT(before.size(), 0u);
  EXPECT_LT(before.size(), 3600u);

  const auto made = certify("");
  ASSERT_EQ(made.exit_code, 0) << made.out << made.err;
  EXPECT_TRUE(says(made.out, " (" + std::to_string(before.size()) + " are stored, "));
  EXPECT_TRUE(contains(made.out, "; until done\n")) << made.out;
  const auto after = trials_of(out);
  EXPECT_EQ(after.size(), 3600u);
  EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()));
  const auto verified = run_assay("verify " + certificate);
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
  EXPECT_TRUE(contains(verified.out, "verified: mine of ")) << verified.out;
  const auto predicate = Json::parse(read_text(certificate))["predicate"];
  const auto& source = predicate["power"]["taken_from"];
  EXPECT_EQ(source["campaign"], "proof");
  EXPECT_EQ(source["seed"], 7);
  for (const std::string digest : {"program", "worker", "generator"})
    EXPECT_EQ(source[digest], predicate["digests"][digest]) << digest;
  EXPECT_EQ(predicate["power"]["planted"], predicate["power"]["found"]);

  hide_a_fault(store);
  const auto tampered = run_assay("verify " + certificate);
  EXPECT_EQ(tampered.exit_code, 1) << tampered.out;
  for (const std::string place : {"/predicate/power/faults/", "/predicate/power/found",
                                  "/predicate/gates/0/state", "/predicate/digests/rows"})
    EXPECT_TRUE(contains(tampered.out, place)) << place << "\n" << tampered.out;
}

// Before any work: the folder of the run is not even made.
TEST_F(Power, IsRefusedInOneLine) {
  const auto refused = [&](const std::string& campaign, const std::string& folder,
                           const std::string& why) {
    const auto words = " --campaign " + campaign + " --out " + out + library + " --power " + folder;
    for (const std::string verb : {"run", "certify"}) {
      expect_refused(run_assay(verb + words), why);
      EXPECT_FALSE(std::filesystem::exists(out)) << why;
    }
  };
  refused(plan, scratch / "nowhere", "nowhere");
  std::filesystem::create_directory(scratch / "empty");
  refused(plan, scratch / "empty", "no run is stored here");

  // Without planted faults, or with fewer cases or seeds than are asked for.
  const auto none = scratch.write("none.json", plan_text(4));
  ASSERT_EQ(run_assay("run --campaign " + none + " --out " + scratch / "none").exit_code, 0);
  refused(plan, scratch / "none", "shows 0 of ");
  refused(scratch.write("more.json", faults_text("more", 21, 1)), proof_folder(),
          "gave each fault 20 cases of 1 seeds, campaign more asks for 21 of 1");
  refused(scratch.write("seeds.json", faults_text("seeds", 20, 2)), proof_folder(),
          "campaign seeds asks for 20 of 2");
  // Where nothing is planted, no proof is wanted.
  const auto ignored = run_assay("run --campaign " + none + " --out " + (scratch / "ignored") +
                                 " --power " + proof_folder());
  EXPECT_EQ(ignored.exit_code, 0) << ignored.err;
  EXPECT_TRUE(contains(ignored.out, "campaign tiny plants no faults: --power is not needed"));

  // A proof of a proof.
  ASSERT_EQ(run(scratch / "second", with_proof).exit_code, 0);
  refused(plan, scratch / "second", "took its own proof from another run");

  // Another build: each of the digests tells.
  for (const std::string digest : {"program", "worker", "generator"}) {
    const auto other = scratch / digest;
    std::filesystem::copy(proof_folder(), other, std::filesystem::copy_options::recursive);
    rebind(other, digest);
    refused(plan, other, "is of another build of assay");
  }
}

TEST_F(Power, IsRefusedInTheFolderOfTheRun) {
  const auto inside = out + "/proof";
  std::filesystem::create_directories(out);
  std::filesystem::copy(proof_folder(), inside, std::filesystem::copy_options::recursive);
  const auto link = scratch / "link";
  std::filesystem::create_directory_symlink(out, link);
  for (const auto& folder : {inside, inside + "/", link + "/proof", out + "/../out/proof"}) {
    expect_refused(run(out, "--power " + folder), "a proof must lie outside of the folder");
    EXPECT_FALSE(std::filesystem::exists(store));
  }
  // Of a run that has its own proof.
  for (const auto& same : {inside, inside + "/"})
    expect_refused(run(same, "--power " + inside), "a proof must lie outside of the folder");
  // A folder beside it whose name begins alike lies outside.
  const auto beside = scratch / "out-proof";
  std::filesystem::copy(proof_folder(), beside, std::filesystem::copy_options::recursive);
  EXPECT_EQ(run(out, "--power " + beside).exit_code, 0);
}

// Of two that say different things neither is believed.
TEST_F(Power, SharesTakeItOverAndAreCertifiedTogether) {
  std::string folders;
  for (const std::string seed : {"1", "2"}) {
    const auto folder = scratch / ("share" + seed);
    const auto part = run(folder, with_proof + " --share 1/2 --seed " + seed);
    ASSERT_EQ(part.exit_code, 3) << part.out << part.err;
    folders += folder + " ";
  }
  const auto both = [&](const std::string& name) {
    return run_assay("verify " + folders + "--out " + scratch / name);
  };
  const auto made = both("both");
  EXPECT_EQ(made.exit_code, 0) << made.out << made.err;
  const auto predicate = Json::parse(read_text(scratch / "both/certificate.json"))["predicate"];
  EXPECT_EQ(predicate["verdict"], "certified");
  EXPECT_EQ(predicate["power"]["taken_from"]["campaign"], "proof");
  EXPECT_EQ(predicate["power"]["planted"], predicate["power"]["found"]);
  const auto hidden = hide_a_fault(scratch / "both/seed-2.sqlite");
  expect_refused(run_assay("report " + (scratch / "both") + " --out " + scratch / "page.html"),
                 "seed-2.sqlite: two runs took over different proofs of " + hidden);
  ASSERT_EQ(both("other").exit_code, 0);
  rename_source(scratch / "other/seed-2.sqlite", "other", "other");
  expect_refused(run_assay("report " + (scratch / "other") + " --out " + scratch / "page.html"),
                 "took over proofs of planted faults from different runs");
  // The key of a row says another name than the row itself.
  rename_source(scratch / "other/seed-2.sqlite", "third", "other");
  expect_refused(run_assay("report " + (scratch / "other") + " --out " + scratch / "page.html"),
                 "power third is not as a run writes it");
}

}  // namespace
}  // namespace assay::tests
