// Records of trials, their counts and sums, and the shards that trials are parted into.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "properties/campaign/phases/canary.h"
#include "properties/campaign/stored/count_names.h"
#include "properties/campaign/trials/case_tally.h"
#include "properties/campaign/trials/trials.h"

namespace assay::properties {
namespace {

TEST(Counts, SurviveTheirText) {
  const Counts counts = {
      {"law:L3_First/premise", 7}, {"tag:a=b", 1}, {"block:V+ V-", 18446744073709551615u}};
  EXPECT_EQ(parse_counts(counts_text(counts)), counts);
  EXPECT_EQ(counts_text({}), "");
  EXPECT_TRUE(parse_counts("").empty());
  EXPECT_EQ(counts_text({{"b", 2}, {"a", 1}}), "a=1;b=2");
  EXPECT_EQ(parse_counts("a=1;a=2"), (Counts{{"a", 3}}));
  Counts sum = {{"a", 1}, {"b", 2}};
  add(sum, {{"b", 3}, {"c", 4}});
  EXPECT_EQ(sum, (Counts{{"a", 1}, {"b", 5}, {"c", 4}}));
}

TEST(Counts, TallyOfAStratum) {
  Tally tally;
  tally.add({"p:1:broken:0", "broken", 0, "HDUE", 5, 2, 1, 3, 10, 20, {{"tag:x", 1}}});
  tally.add({"p:1:broken:1", "broken", 1, "HHDH", 4, 1, 0, 0, 1, 2, {{"tag:x", 1}}});
  // A case that the detector's numbers do not hold is a trial of no configuration.
  tally.add({"p:1:broken:2", "broken", 2, "", 0, 0, 0, 0, 0, 0, {}});
  tally.add({"p:1:closed-generic:0", "closed-generic", 0, "H", 200, 1, 1, 1, 0, 0, {}});
  EXPECT_EQ(tally.counts, (Counts{{"tag:x", 2}}));
  ASSERT_EQ(tally.strata.size(), 2u);
  const auto& broken = tally.strata.at("broken");
  EXPECT_EQ(broken.trials, 3u);
  EXPECT_EQ(broken.steps, 3u);
  EXPECT_EQ(broken.collisions, 1u);
  EXPECT_EQ(broken.pairs, 3u);
  EXPECT_EQ(broken.oracle_us, 11u);
  EXPECT_EQ(broken.detector_us, 22u);
  ASSERT_EQ(broken.by_configuration.size(), 4u);
  EXPECT_EQ(broken.by_configuration[0].holds, 2u);
  EXPECT_EQ(broken.by_configuration[1].defects, 1u);
  EXPECT_EQ(broken.by_configuration[2].undecided, 1u);
  EXPECT_EQ(broken.by_configuration[2].defects, 1u);
  EXPECT_EQ(broken.by_configuration[3].errors, 1u);
  EXPECT_EQ(broken.sizes, (std::map<int, std::uint64_t>{{-1, 1}, {2, 2}}));
  EXPECT_EQ(broken.contacts, (std::map<int, std::uint64_t>{{-1, 2}, {1, 1}}));
  EXPECT_EQ(tally.strata.at("closed-generic").sizes, (std::map<int, std::uint64_t>{{7, 1}}));
}

TEST(Counts, LettersOfOutcomes) {
  EXPECT_EQ(letter_of(Outcome::holds), 'H');
  EXPECT_EQ(letter_of(Outcome::defect), 'D');
  EXPECT_EQ(letter_of(Outcome::undecided), 'U');
  EXPECT_EQ(letter_of(Outcome::error), 'E');
}

TEST(Shards, PartitionTheTrials) {
  CampaignPlan plan;
  plan.strata = {{"broken", 25, 0}, {"closed-generic", 2, 0}, {"closed-degenerate", 0, 0}};
  for (const std::uint64_t count : {1u, 2u, 3u, 7u, 40u}) {
    std::uint64_t planned = 0;
    std::vector<int> holders(25);
    for (std::uint64_t i = 1; i <= count; ++i) {
      const Shard shard{i, count};
      planned += planned_trial_count(plan, shard);
      for (std::uint64_t place = 0; place < 25; ++place) holders[place] += shard.holds(place);
    }
    EXPECT_EQ(planned, 27u) << count;
    EXPECT_EQ(holders, std::vector<int>(25, 1)) << count;
  }
  EXPECT_EQ(planned_trial_count(plan, {1, 1}), 27u);
  EXPECT_EQ(planned_trial_count(plan, {3, 3}), 8u);
}

}  // namespace
}  // namespace assay::properties
