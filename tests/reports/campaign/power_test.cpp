// `--power DIR`: another run of this build has proved that planted faults are found, and the proof
// is reused.
#include "properties/campaign/gates/gates.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

// A run that plants all faults and finds them.
class Power : public testing::Test {
 protected:
  using Json = nlohmann::ordered_json;
  using Rows = std::vector<properties::Row>;

  // The curated cases show each of the faults, so that few random ones will do. The tests of a
  // process share it and leave it as it is.
  static void SetUpTestSuite() {
    shared = std::make_unique<Scratch>();
    const auto plan = shared->write("proof.json", faults_text("proof", 20, 1));
    expect_ended("run --seed 7 --jobs 2 --campaign " + plan + " --out " + proof_folder(), 0,
                 {" by their curated case alone\n"});
  }
  static void TearDownTestSuite() { shared.reset(); }
  static std::string proof_folder() { return *shared / "proof"; }

  // A campaign that plants faults. `cases`: of each of its families.
  static std::string faults_text(const std::string& name, int cases_of_a_fault, int seeds,
                                 int cases = 8) {
    auto plan = Json::parse(R"({"schema": "assay-campaign/1", "seconds": null,
                                "policy": {"self_test_queries": 20}})");
    for (const char* family : {"closed-generic", "unclosed-generic", "broken"})
      plan["strata"].push_back({{"family", family}, {"cases", cases}});
    plan["name"] = name, plan["fault_cases"] = cases_of_a_fault, plan["fault_seeds"] = seeds;
    return plan.dump();
  }

  static properties::Store open(const std::string& file) {
    std::string binding = properties::Store::read(file).value().binding();
    return std::move(properties::Store::open(file, binding).value());
  }
  static Rows rows_of(const std::string& file, const std::string& kind) {
    Rows rows = open(file).evidence();
    std::erase_if(rows, [&](const auto& row) { return row.kind != kind; });
    return rows;
  }
  // Another binding of a folder's only store.
  static void rebind(const std::string& folder, const std::string& digest) {
    auto store = open(folder + "/run.sqlite");
    auto binding = Json::parse(store.binding());
    binding["digests"][digest] = std::string(64, '0');
    store.set({"binding", "", 0, binding.dump()});
    EXPECT_TRUE(store.seal());
  }
  // Makes of the first planted fault that a run took over one that was not found: its name.
  static std::string hide_a_fault(const std::string& file) {
    auto rows = rows_of(file, "fault");
    auto store = open(file);
    for (auto& row : rows) {
      auto facts = Json::parse(row.fields);
      if (facts["status"] != "planted") continue;
      facts["curated"] = false;
      for (auto& needed : facts["needed"]) needed = nullptr;
      row.fields = facts.dump();
      store.set(row);
      EXPECT_TRUE(store.seal());
      return row.key;
    }
    ADD_FAILURE() << file << " has no fault that was taken over";
    return "";
  }
  // Makes the campaign that a run took its proof from another one.
  static void rename_source(const std::string& file, const std::string& key,
                            const std::string& campaign) {
    auto sources = rows_of(file, "power");
    ASSERT_EQ(sources.size(), 1u);
    auto store = open(file);
    store.drop("power");
    auto fields = nlohmann::json::parse(sources[0].fields);
    fields["campaign"] = campaign;
    sources[0].key = key, sources[0].fields = fields.dump();
    store.set(sources[0]);
  }

  const Scratch scratch;
  const std::string library = " --detector " + plugin("wrapped_builtin");
  const std::string with_proof = " --power " + proof_folder();

  const std::string plan = scratch.write("plan.json", faults_text("mine", 20, 1));
  const std::string out = scratch / "out", store = out + "/run.sqlite";
  Outcome run(const std::string& folder, const std::string& more) const {
    return run_assay("run --campaign " + plan + " --out " + folder + library + " " + more);
  }

 private:
  inline static std::unique_ptr<Scratch> shared;
};

TEST_F(Power, OfAnotherRunIsCopiedToldAndJudged) {
  const auto made = expect_ended(run(out, with_proof), 0);
  EXPECT_TRUE(says(made.out,
                   "; planted faults were found by campaign proof, seed 7, of this "
                   "build; "));
  const auto proved = rows_of(proof_folder() + "/run.sqlite", "fault");
  expect_says(made.out, {" by their curated case alone; campaign proof, seed 7, of this build\n"});
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
  const auto findings = value_of(properties::read_findings(proof_folder()));
  EXPECT_EQ(Json::parse(sources[0].fields)["rows"], findings.rows);

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
  expect_ended(certify(" --time 1"), 3,
               {"\ncomplete   FAILS\n  closed-generic: ", "\nverdict: incomplete in "});
  const std::string certificate = out + "/certificate.json";
  EXPECT_EQ(predicate_in(out)["verdict"], "incomplete");
  const auto before = trials_of(out);
  EXPECT_GT(before.size(), 0u);
  EXPECT_LT(before.size(), 3600u);

  const auto made = expect_ended(certify(""), 0);
  EXPECT_TRUE(says(made.out, " (" + std::to_string(before.size()) + " are stored, "));
  EXPECT_TRUE(contains(made.out, "; until done\n")) << made.out;
  const auto after = trials_of(out);
  EXPECT_EQ(after.size(), 3600u);
  EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()));
  expect_ended("verify " + certificate, 0, {"verified: mine of "});
  const auto predicate = predicate_in(out);
  const auto& source = predicate["power"]["taken_from"];
  EXPECT_EQ(source["campaign"], "proof");
  EXPECT_EQ(source["seed"], 7);
  for (const std::string digest : {"program", "worker", "generator"})
    EXPECT_EQ(source[digest], predicate["digests"][digest]) << digest;
  EXPECT_EQ(predicate["power"]["planted"], predicate["power"]["found"]);

  hide_a_fault(store);
  expect_ended("verify " + certificate, 1,
               {"/predicate/power/faults/", "/predicate/power/found", "/predicate/gates/0/state",
                "/predicate/digests/rows"});
}

// Before any work: the folder of the run is not even made.
TEST_F(Power, IsRefusedInOneLine) {
  const auto refused = [&](const std::string& campaign, const std::string& folder,
                           const std::string& why) {
    const auto words = " --campaign " + campaign + " --out " + out + library + " --power " + folder;
    for (const std::string verb : {"run", "certify"}) {
      expect_refused(verb + words, why);
      EXPECT_FALSE(std::filesystem::exists(out)) << why;
    }
  };
  refused(plan, scratch / "nowhere", "nowhere");
  std::filesystem::create_directory(scratch / "empty");
  refused(plan, scratch / "empty", "no run is stored here");

  // Without planted faults, or with fewer cases or seeds than are asked for.
  const auto none = scratch.write("none.json", plan_text(4));
  ASSERT_EQ(run_assay("run --campaign " + none + " --out " + scratch / "none").exit_code, 0);
  refused(plan, scratch / "none", "found 0 of ");
  refused(scratch.write("more.json", faults_text("more", 21, 1)), proof_folder(),
          "tried each fault on 20 cases under 1 seeds, but campaign more wants 21 cases under 1");
  refused(scratch.write("seeds.json", faults_text("seeds", 20, 2)), proof_folder(),
          "campaign seeds wants 20 cases under 2");
  // Where nothing is planted, no proof is wanted.
  expect_ended(
      "run --campaign " + none + " --out " + (scratch / "ignored") + " --power " + proof_folder(),
      0, {"campaign tiny plants no faults: --power is not needed"});

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
    expect_ended(run(folder, with_proof + " --share 1/2 --seed " + seed), 3);
    folders += folder + " ";
  }
  const auto both = [&](const std::string& name) {
    return run_assay("verify " + folders + "--out " + scratch / name);
  };
  expect_ended(both("both"), 0);
  const auto predicate = predicate_in(scratch / "both");
  EXPECT_EQ(predicate["verdict"], "certified");
  EXPECT_EQ(predicate["power"]["taken_from"]["campaign"], "proof");
  EXPECT_EQ(predicate["power"]["planted"], predicate["power"]["found"]);
  const auto hidden = hide_a_fault(scratch / "both/seed-2.sqlite");
  expect_refused("report " + (scratch / "both") + " --out " + scratch / "page.html",
                 "seed-2.sqlite: two runs took over different proofs for " + hidden);
  ASSERT_EQ(both("other").exit_code, 0);
  rename_source(scratch / "other/seed-2.sqlite", "other", "other");
  expect_refused("report " + (scratch / "other") + " --out " + scratch / "page.html",
                 "took over proofs of planted faults from different runs");
  // The key of a row says another name than the row itself.
  rename_source(scratch / "other/seed-2.sqlite", "third", "other");
  expect_refused("report " + (scratch / "other") + " --out " + scratch / "page.html",
                 "power third: no run writes such a row");
}

}  // namespace
}  // namespace assay::tests
