// Conditions of a run: its binding, its canary, and laws whose premises held too seldom.
#include "properties/campaign/ledger/binding.h"

#include "properties/campaign/ledger/store.h"
#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/trials/trials.h"
#include "properties/laws/law.h"
#include "tests/problem_words.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/properties/campaign/good_findings.h"
#include "tests/properties/small_case.h"
#include "tests/reports/program.h"

namespace assay::properties {
namespace {

using test::request_of;

TEST(Binding, ChangesWithWhatTheTrialsAreOf) {
  const auto request = request_of(10);
  const std::string text = binding_of(request);
  const auto changed = [&](const std::function<void(CampaignRequest&)>& change) {
    auto other = request;
    change(other);
    return binding_of(other);
  };
  const std::set<std::string> texts = {
      text, changed([](auto& r) { r.seed = 4; }), changed([](auto& r) { r.shares = 2; }),
      changed([](auto& r) { r.plan.strata[0].cases = 11; }),
      changed([](auto& r) { r.plan.case_seconds = 11; }),
      changed([](auto& r) { r.plan.case_bytes = 0; }),
      changed([](auto& r) { r.detector.configurations.pop_back(); }),
      changed([](auto& r) { r.worker = "/bin/true"; }),
      // Two of the same name and version.
      changed([](auto& r) { r.plugin = test::plugin("always_free"); }),
      changed([](auto& r) { r.plugin = test::plugin("always_collision"); })};
  EXPECT_EQ(texts.size(), 10u);
  EXPECT_EQ(changed([](auto& r) {
              r.plan.seconds = 7;  // a run that ran out of time may go on
              r.jobs = 5;
            }),
            text);
}

TEST(Binding, OfRunsThatAreJudgedTogetherMayDifferInSeedAndShare) {
  const auto request = request_of(10);
  auto other = request;
  other.seed = 4;
  other.shares = 8;
  const auto one = binding_of(request), two = binding_of(other);
  EXPECT_EQ(difference_of(one, two), "seed 3 and 4, shares 1 and 8");
  EXPECT_EQ(difference_of(one, two, Runs::judged_together), "");
  other.plan.strata[0].cases = 11;
  EXPECT_EQ(difference_of(one, binding_of(other), Runs::judged_together),
            "campaign/strata/0/cases 10 and 11");
  // No run does none of a campaign, nor less than its smallest share.
  for (const char* shares : {"0", "1000001", "-1"}) {
    auto wrong = two;
    wrong.replace(wrong.find("\"shares\":"), 10, std::string("\"shares\":") + shares + "");
    EXPECT_FALSE(read_binding(wrong, "file")) << wrong;
  }
}

TEST(Canary, IsRegisteredAndFound) {
  const auto canary = meet_canary(request_of(1));
  EXPECT_TRUE(find_fault(canary.fault)) << canary.fault;
  EXPECT_TRUE(canary.found_after);
  // Without a worker nothing is said of it.
  auto blind = request_of(1);
  blind.worker = "/bin/true";
  EXPECT_THROW(meet_canary(blind), StoreProblem);
}

TEST(Starved, LawsAreNamed) {
  const std::string name(laws()[0].name);
  TrialCounts counts;
  for (const auto& law : laws()) {
    auto& count = counts.laws[std::string(law.name)];
    count = {100, 25, 0, {}};
    for (const char* culling : {"auto", "view-auto", "view-point", "view-line"})
      count.by_culling[culling] = 50;
  }
  EXPECT_TRUE(starved_laws(counts, 100).empty());
  EXPECT_EQ(starved_laws(counts, 101).size(), laws().size());
  counts.laws[name].close = 24;
  ASSERT_EQ(starved_laws(counts, 100).size(), 1u);
  EXPECT_NE(starved_laws(counts, 100)[0].find(name), std::string::npos);
  counts.laws[name].premise = 0;
  EXPECT_NE(starved_laws(counts, 1).at(0).find("held in 0 steps"), std::string::npos);
  EXPECT_TRUE(starved_laws(counts, 0).empty());
  const auto under = [&](const char* law, const char* culling) -> std::uint64_t& {
    return counts.laws[law].by_culling[culling];
  };
  const std::size_t before = starved_laws(counts, 100).size();
  under("L8_CarriedCleanIsClean", "view-line") = 4;  // a tenth of 100 is 10
  under("L15_StepsWithoutViewsAreInTheAccount", "auto") = 0;
  under("L15_StepsWithoutViewsAreInTheAccount", "view-point") = 0;  // it has views in every step
  under("L4_AllPositiveIsCollisionFree_Line", "auto") = 0;          // any culling will do
  const auto lines = starved_laws(counts, 100);
  ASSERT_EQ(lines.size(), before + 2);
  EXPECT_NE(std::find(lines.begin(), lines.end(),
                      "the premise of L8_CarriedCleanIsClean held in 4 steps under view-line, but "
                      "10 are wanted"),
            lines.end());
  EXPECT_EQ(broken_laws(counts), 0u);
  counts.laws[name].broken = 3;
  EXPECT_EQ(broken_laws(counts), 1u);
}

// What a folder lacks to be the proof of planted faults, by name: a caller may then tell a wrong
// folder from a run that has to be repeated.

class PowerProofs : public testing::Test {
 protected:
  PowerProofs() : request(request_of(2)) {
    request.plan.fault_cases = 10;
    request.plan.fault_seeds = 1;
  }

  // A folder with a run that found all planted faults, but for so many that it left out.
  std::string proof_without(std::size_t left_out, const std::string& binding) const {
    const std::string folder = scratch / "proof" + std::to_string(left_out);
    std::filesystem::create_directories(folder);
    auto store = test::open_store(store_file(folder), binding);
    for (const auto& fault : faults()) {
      if (fault.status != FaultStatus::planted || (left_out > 0 && left_out-- > 0)) continue;
      store.set(to_row(test::fault_proof(std::string(fault.name), fault.status, true)));
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
  expect_refused(scratch / "nowhere", "so it needs no proof");
}

}  // namespace
}  // namespace assay::properties
