// `assay verify --again`: a certificate that was forged together with its stores verifies, and its
// trials do not come to what it says.
#include <fmt/format.h>

#include "properties/campaign/ledger/record.h"
#include "tests/reports/certificate/issued_folder.h"
#include "tests/reports/run_fixture.h"

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
    const auto again = verify("--again 1 --seed 3");
    EXPECT_EQ(again.exit_code, 1) << again.out << again.err;
    EXPECT_TRUE(contains(again.out, line)) << again.out;
    EXPECT_TRUE(says(again.out, "NOT VERIFIED: " + out +
                                    "/certificate.json, 32 of 32 trials "
                                    "run again, seed 3; it says nothing\n"));
  }
};

TEST_F(VerifyAgain, NamesAForgedTrialOfTheBuiltInDetector) {
  run_and_issue("");
  const auto honest = verify("--again 1");
  EXPECT_EQ(honest.exit_code, 0) << honest.out << honest.err;
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
    expect_named(fmt::format("trial {}: {} {} now, 7654 stored\n", id, was, name));
    forge(id, [&](TrialRecord& record) { record.*number = was; });
  }
  forge(id, [](TrialRecord& record) { record.mesh = 7654; });
  expect_named(fmt::format("trial {}: its mesh is another one\n", id));
  const auto refused = verify("--again 1 --detector " + plugin("always_free"));
  EXPECT_EQ(refused.exit_code, 2) << refused.out;
  EXPECT_TRUE(contains(refused.err, "the built-in detector")) << refused.err;
}

TEST_F(VerifyAgain, NamesAForgedVerdictOnAPlugIn) {
  const auto library = plugin("always_free");
  run_and_issue("--detector " + library);
  const auto honest = verify("--again 0.5 --seed 1");
  EXPECT_EQ(honest.exit_code, 1) << "its verdict is a defect";
  EXPECT_TRUE(contains(honest.out, "again: 16 of 32 trials, seed 1: all as they are stored\n"))
      << honest.out << honest.err;
  // A defect becomes a success.
  std::string id;
  {
    const auto store = Store::read(store_file(out));
    ASSERT_TRUE(store);
    store.value().for_each_trial([&](const TrialRecord& r) {
      if (r.outcomes == "D" && id.empty()) id = r.id;
    });
  }
  ASSERT_FALSE(id.empty());
  forge(id, [](TrialRecord& record) { record.outcomes = "H"; });
  expect_named(fmt::format("trial {}: constant answer is D now, H is stored\n", id));
  forge(id, [](TrialRecord& record) { record.outcomes = "D"; });

  // The library as it is named, a copy of it, and another one.
  const auto copy = scratch / "copy.so";
  std::filesystem::copy_file(library, copy);
  EXPECT_TRUE(contains(verify("--again 0.1 --detector " + copy).out, "all as they are stored"));
  const auto other = verify("--again 0.1 --detector " + plugin("always_collision"));
  EXPECT_EQ(other.exit_code, 2) << other.out;
  EXPECT_TRUE(contains(other.err, "not the library that was certified")) << other.err;
  const auto none = verify("--again 0.1 --detector " + (scratch / "none.so"));
  EXPECT_EQ(none.exit_code, 2) << none.out;
}

}  // namespace
}  // namespace assay::tests
