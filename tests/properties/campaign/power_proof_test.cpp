// What a folder lacks to be the proof of planted faults, by name: a caller may then tell a wrong
// folder from a run that has to be repeated.
#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/campaign/phases/fault_hunt.h"
#include "tests/problem_words.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/properties/campaign/good_findings.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

class PowerProofs : public testing::Test {
 protected:
  PowerProofs() : request(test::request_of(2)) {
    request.plan.fault_cases = 10;
    request.plan.fault_seeds = 1;
  }

  // A folder with a run that found all planted faults, but for so many that it left out.
  std::string proof_without(std::size_t left_out, const std::string& binding) const {
    const std::string folder = scratch / "proof" + std::to_string(left_out);
    std::filesystem::create_directories(folder);
    auto opened = Store::open(store_file(folder), binding);
    EXPECT_TRUE(opened) << opened.error().message;
    for (const auto& fault : faults()) {
      if (fault.status != FaultStatus::planted) continue;
      if (left_out > 0) {
        --left_out;
        continue;
      }
      opened.value().set(to_row(test::fault_proof(std::string(fault.name), fault.status, true)));
    }
    return folder;
  }
  void expect_refused(const std::filesystem::path& folder, std::string_view words) const {
    const auto proof = take_power(folder, scratch / "out", request);
    ASSERT_FALSE(proof) << words;
    EXPECT_TRUE(says(proof.error(), words));
  }

  const tests::Scratch scratch;
  CampaignRequest request;
};

TEST_F(PowerProofs, OfARunOfThisBuildAreTaken) {
  const auto folder = proof_without(0, binding_of(request));
  const auto proof = take_power(folder, scratch / "out", request);
  ASSERT_TRUE(proof) << proof.error().message;
  EXPECT_EQ(proof.value().faults.size(), planted_count());
  EXPECT_EQ(proof.value().source.campaign, request.plan.name);
}

TEST_F(PowerProofs, WhatIsNoneIsRefused) {
  expect_refused(scratch / "nowhere", "nowhere: No such file");
  std::filesystem::create_directory(scratch / "empty");
  expect_refused(scratch / "empty", "no run is stored here");
  expect_refused(scratch / "out/inside", "a proof must lie outside");
  expect_refused(proof_without(1, binding_of(request)), ": the run ");
  auto other = request;
  other.worker = "/bin/true";
  expect_refused(proof_without(0, binding_of(other)), "of another build of assay");
  request.plan.fault_cases = 0;
  expect_refused(scratch / "nowhere", "no proof of them is needed");
}

}  // namespace
}  // namespace assay::properties
