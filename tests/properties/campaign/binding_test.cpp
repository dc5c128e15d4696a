// What a run rests on: its binding, its canary, and laws that were met too seldom.
#include "properties/campaign/ledger/binding.h"

#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/phases/fault_hunt.h"
#include "properties/campaign/trials/trials.h"
#include "properties/laws/law.h"
#include "tests/properties/campaign/campaign_request.h"
#include "tests/properties/small_case.h"

namespace assay::properties {
namespace {

using test::request_of;

TEST(Binding, ChangesWithWhatTheTrialsAreOf) {
  const auto request = request_of(10);
  const std::string text = binding_of(request);
  auto other = request;
  other.seed = 4;
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.shares = 2;
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.plan.strata[0].cases = 11;
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.plan.case_seconds = 11;
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.plan.case_bytes = 0;
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.detector.configurations.pop_back();
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.worker = "/bin/true";
  EXPECT_NE(binding_of(other), text);
  other = request;
  other.plugin = test::plugin("always_free");
  const std::string free = binding_of(other);
  EXPECT_NE(free, text);
  other.plugin = test::plugin("always_collision");  // of the same name and version
  EXPECT_NE(binding_of(other), free);
  other = request;
  other.plan.seconds = 7;  // a run that ran out of time may go on
  other.jobs = 5;
  EXPECT_EQ(binding_of(other), text);
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
  EXPECT_NE(starved_laws(counts, 1).at(0).find("held 0 times"), std::string::npos);
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
                      "the premise of L8_CarriedCleanIsClean held 4 times under view-line, 10 are "
                      "wanted"),
            lines.end());
  EXPECT_EQ(broken_laws(counts), 0u);
  counts.laws[name].broken = 3;
  EXPECT_EQ(broken_laws(counts), 1u);
}

}  // namespace
}  // namespace assay::properties
