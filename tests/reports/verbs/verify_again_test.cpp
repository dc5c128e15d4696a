// `assay verify --again`: if a certificate is forged together with its stores, plain `verify`
// passes, but repeated trials contradict the certificate.
#include <fmt/format.h>

#include "properties/campaign/ledger/record.h"
#include "tests/reports/certificate/issued_folder.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

using namespace properties;

class VerifyAgain : public RunFixture {
 protected:
  // A certificate of the run alone: what is asked of it is what `run` asks for.
  void run_and_issue(const std::string& more) {
    const auto made = run(more);
    ASSERT_LE(made.exit_code, 1) << made.out << made.err;
    write_bytes(campaign_file(out), properties::plan_text(find_plan(plan).value()) + "\n");
    issue(out);
  }
  Outcome verify(const std::string& more) const {
    return run_assay("verify " + out + "/certificate.json " + more);
  }
  // Changes the trial, mends its hash, and issues the certificate anew.
  void forge(const std::string& id, const std::function<void(TrialRecord&)>& change) {
    {
      const Database database(store_file(out), Database::Mode::write);
      std::vector<Row> rows;
      for_each_row(database, "WHERE kind='trial' AND key=?", {id},
                   [&](const Row& row) { rows.push_back(row); });
      ASSERT_EQ(rows.size(), 1u) << id;
      TrialRecord record = trial_of(rows[0]);
      change(record);
      put_row(database, to_row(record));
    }
    issue(out);
  }
  void expect_named(const std::string& line) const {
    expect_ended(verify("--again 1 --seed 3"), 1,
                 {line, "NOT VERIFIED: " + out +
                            "/certificate.json, 32 of 32 trials "
                            "run again, seed 3; it proves nothing\n"});
  }
};

TEST_F(VerifyAgain, NamesAForgedTrialOfTheBuiltInDetector) {
  run_and_issue("");
  expect_ended(verify("--again 1"), 0);
  const std::string id = "tiny:1:broken:5";
  const std::pair<std::uint64_t TrialRecord::*, const char*> numbers[] = {
      {&TrialRecord::triangles, "triangles"},
      {&TrialRecord::steps, "steps"},
      {&TrialRecord::collisions, "collisions"},
      {&TrialRecord::pairs, "pairs"}};
  for (const auto& [member, name] : numbers) {
    const auto number = member;
    std::uint64_t was = 0;
    forge(id, [&](TrialRecord& record) { was = std::exchange(record.*number, 7654); });
    EXPECT_LE(verify("").exit_code, 1);
    EXPECT_TRUE(contains(verify("").out, "verified: ")) << "the forgery is whole";
    expect_named(fmt::format("trial {}: {} {} now, but 7654 stored\n", id, was, name));
    forge(id, [&](TrialRecord& record) { record.*number = was; });
  }
  forge(id, [](TrialRecord& record) { record.mesh = 7654; });
  expect_named(fmt::format("trial {}: its mesh differs from the stored mesh\n", id));
  expect_problem(verify("--again 1 --detector " + plugin("always_free")), "the built-in detector");
}

TEST_F(VerifyAgain, NamesAForgedVerdictOnAPlugIn) {
  const auto library = plugin("always_free");
  run_and_issue("--detector " + library);
  // Its verdict is a defect.
  expect_ended(verify("--again 0.5 --seed 1"), 1,
               {"again: 16 of 32 trials, seed 1: all results are as stored\n"});
  // A defect becomes a success.
  std::string id;
  {
    const auto store = value_of(Store::read(store_file(out)));
    store.for_each_trial([&](const TrialRecord& r) {
      if (r.outcomes == "D" && id.empty()) id = r.id;
    });
  }
  ASSERT_FALSE(id.empty());
  forge(id, [](TrialRecord& record) { record.outcomes = "H"; });
  expect_named(fmt::format("trial {}: constant answer has outcome D now, but H is stored\n", id));
  forge(id, [](TrialRecord& record) { record.outcomes = "D"; });

  // The library as it is named, a copy of it, and another one.
  const auto copy = scratch / "copy.so";
  std::filesystem::copy_file(library, copy);
  EXPECT_TRUE(contains(verify("--again 0.1 --detector " + copy).out, "all results are as stored"));
  expect_problem(verify("--again 0.1 --detector " + plugin("always_collision")),
                 "not the library that was certified");
  expect_ended(verify("--again 0.1 --detector " + (scratch / "none.so")), 2);
}

}  // namespace
}  // namespace assay::tests
