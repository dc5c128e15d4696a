// A store that fails in the middle of the work: whoever runs a campaign is told by a value.
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/campaign/phases/phases.h"
#include "tests/problem_words.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

// As if somebody changed the file while it is written.
void drop_table(const std::filesystem::path& file) {
  Database(file, Database::Mode::write).run("DROP TABLE ledger");
}

// Drops the table when a phase begins, and notes how far the campaign came.
class Saboteur : public CampaignObserver {
 public:
  Saboteur(std::filesystem::path file, std::string phase)
      : file_(std::move(file)), phase_(std::move(phase)) {}
  void on_begin(std::uint64_t /*trials*/) override { on_phase("begin"); }
  void on_phase(const char* phase) override {
    last = phase;
    if (phase == phase_) drop_table(file_);
  }
  std::string last;

 private:
  std::filesystem::path file_;
  std::string phase_;
};

class FailingStore : public testing::Test {
 protected:
  void expect_told(const std::string& phase) const {
    const std::filesystem::path file = scratch / (phase + ".sqlite");
    const auto request = test::request_of(4, 2);
    auto store = Store::open(file, binding_of(request));
    ASSERT_TRUE(store) << store.error().message;
    Saboteur saboteur(file, phase);
    const auto ran = run_campaign(request, "", store.value(), saboteur);
    ASSERT_FALSE(ran) << phase;
    EXPECT_TRUE(says(ran.error(), "no such table: ledger"));
    EXPECT_EQ(saboteur.last, phase);
  }
  const tests::Scratch scratch;
};

TEST_F(FailingStore, EndsACampaignByAValue) {
  expect_told("begin");
  // In the threads of the trials: where they ask what is stored, and where they store.
  expect_told("trials");
  expect_told("shrinking");
}

TEST_F(FailingStore, IsNotedOnceByWhoeverStoresChecks) {
  const auto request = test::request_of(4);
  auto opened = Store::open(store_file(scratch / ""), binding_of(request));
  ASSERT_TRUE(opened) << opened.error().message;
  Checks checks(opened.value());
  checks.keep(Paths{"out", ""});
  ASSERT_FALSE(checks.problem());
  ASSERT_TRUE(checks.corpus_failures());
  drop_table(store_file(scratch / ""));
  checks.keep(Paths{"out", ""});
  ASSERT_TRUE(checks.problem());
  EXPECT_TRUE(says(*checks.problem(), "no such table: ledger"));
  const std::string first = checks.problem()->message;
  // Nothing more is stored, and the first problem stays the one that is told.
  bool was_called = false;
  checks.update([&](Store&) { was_called = true; });
  EXPECT_FALSE(was_called);
  EXPECT_EQ(checks.problem()->message, first);
  ASSERT_FALSE(checks.corpus_failures());
  EXPECT_EQ(checks.corpus_failures().error().message, first);
}

}  // namespace
}  // namespace assay::properties
