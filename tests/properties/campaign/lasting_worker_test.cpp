// One process of a plug-in is asked at the beginning of a campaign and again at its end.
#include "properties/campaign/phases/lasting_worker.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/phases/phases.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

// Makes a file as the last phase before the end begins. So no clock decides what the test sees.
class MakesFile : public CampaignObserver {
 public:
  explicit MakesFile(std::string file) : file_(std::move(file)) {}
  void on_phase(const char* phase) override {
    if (phase == std::string("tetrahedron")) std::ofstream(file_) << "now";
  }
  void on_asked_again(const AskedAgain& row, double seconds) override {
    asked = row;
    EXPECT_GE(seconds, 0);
  }
  AskedAgain asked;

 private:
  std::string file_;
};

class LastingWorkers : public testing::Test {
 protected:
  // Runs a campaign with a plug-in that answers free once there is the file.
  void run(const std::string& words) {
    const std::string late = scratch / "late";
    ::setenv("ASSAY_QUERY", (words + late).c_str(), 1);
    auto request = test::request_of(20);
    request.plan.laws_every = 0;
    request.plan.fault_cases = 0;
    request.plan.tetrahedron_seconds = 0.01;
    request.plan.policy.repeated_triangles = 60;
    request.limits.isolation = IsolationMode::none;  // so that it sees the file
    test::set_plugin(request, test::plugin("steps_and_query"));
    MakesFile observer(late);
    auto store = Store::open(scratch / "store.sqlite", binding_of(request));
    ASSERT_TRUE(store);
    ASSERT_TRUE(run_campaign(request, "", store.value(), observer));
    ::unsetenv("ASSAY_QUERY");
    asked = observer.asked;
    failures = store.value().failures();
    stored = facts_in(store.value()).asked_again;
  }
  const tests::Scratch scratch;
  AskedAgain asked;
  std::vector<StoredFailure> failures;
  std::vector<AskedAgain> stored;
};

TEST_F(LastingWorkers, WhoAnswersOtherwiseAtTheEndIsFound) {
  run("free-once=");
  EXPECT_GT(asked.wrong, 0u);
  EXPECT_LT(asked.wrong, asked.cases) << "what was free is free";
  ASSERT_FALSE(failures.empty());
  bool of_a_trial = false, of_a_sequence = false;
  for (const auto& failure : failures) {
    EXPECT_TRUE(failure.id.starts_with(asked_again_in_id)) << failure.id;
    EXPECT_EQ(failure.signature.substr(0, 25), "free-sound: answered free") << failure.signature;
    EXPECT_TRUE(failure.signature.ends_with(", asked at the end")) << failure.signature;
    EXPECT_TRUE(failure.flaky);
    (failure.id.find("/long-sequence") == std::string::npos ? of_a_trial : of_a_sequence) = true;
  }
  EXPECT_TRUE(of_a_trial);
  EXPECT_TRUE(of_a_sequence);
  ASSERT_EQ(stored.size(), 1u);
  EXPECT_EQ(stored[0].wrong, asked.wrong);
}

// Without that claim the oracle judges the new answer.
TEST_F(LastingWorkers, WhoDoesNotClaimToBeDeterministicIsFoundToo) {
  run("claims=129 free-once=");
  EXPECT_GT(asked.wrong, 0u);
}

TEST_F(LastingWorkers, WhoStaysRightHolds) {
  run("print-nothing=");
  EXPECT_GT(asked.cases, 4u);
  EXPECT_GT(asked.steps, 120u) << "the long sequence is among them";
  EXPECT_EQ(asked.wrong + asked.open, 0u);
  EXPECT_TRUE(failures.empty());
}

}  // namespace
}  // namespace assay::properties
