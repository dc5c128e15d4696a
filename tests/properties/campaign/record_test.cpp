// Records of trials, their counts and sums, and the shares of a campaign.
#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/phases/fault_hunt.h"
#include "properties/campaign/trials/case_tally.h"
#include "properties/campaign/trials/trials.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

TEST(Counts, AddUpByName) {
  TrialCounts sum = {
      {{"a", 1}, {"b", 2}}, {{"V+/V-", {3, 1}}}, {{"L3", {5, 2, 0, {{"auto", 4}}}}}, {}};
  sum += {{{"b", 3}, {"c", 4}}, {{"V+/V-", {1, 1}}}, {{"L3", {1, 1, 1, {{"bvh", 1}}}}}, {}};
  EXPECT_EQ(sum, (TrialCounts{{{"a", 1}, {"b", 5}, {"c", 4}},
                              {{"V+/V-", {4, 2}}},
                              {{"L3", {6, 3, 1, {{"auto", 4}, {"bvh", 1}}}}},
                              {}}));
  sum.extremes = {1, 20, 3, 40, 5, 60};
  sum += {{}, {}, {}, {}, {10, 2, 30, 4, 50, 6}};
  EXPECT_EQ(sum.extremes, (Extremes{10, 20, 30, 40, 50, 60}));
}

TEST(Records, SurviveTheirRows) {
  TrialRecord trial{"quick:1:broken:12", "broken", 12, "HD", 1, 2, 3, 4, 5, 6, {},
                    ~std::uint64_t{0},   1,        8};
  trial.counts = {{{"shape:x", 1}}, {{"V+/V-", {3, 1}}}, {{"L3", {5, 2, 0, {{"auto", 4}}}}}, {}};
  trial.counts.measures.redrawn = 3;
  trial.counts.measures.relation_trials = 1;
  trial.counts.extremes = {1, 2, 3, 4, 5, 6};
  trial.counts.measures.errors.steps = 4;
  trial.counts.measures.errors.late = {2, 0.0123, 7, {{0.013, 1}, {0.001, 1}}};
  const Row row = to_row(trial);
  EXPECT_EQ(row_name(row), "trial quick:1:broken:12");
  const TrialRecord back = trial_of(row);
  EXPECT_EQ(to_row(back), row);
  EXPECT_EQ(back.family, "broken");
  EXPECT_EQ(back.index, 12u);
  EXPECT_EQ(back.counts, trial.counts);
  EXPECT_EQ(back.mesh, trial.mesh);
  // What is 0 takes no room.
  TrialRecord small;
  small.id = "q:1:broken:0";
  small.outcomes = "H";
  EXPECT_EQ(to_row(small).fields, R"({"outcomes":"H"})");
  const StoredFailure failure{"quick:1:broken:12", "bvh", "s", "what", "mesh", "small", true, "p"};
  EXPECT_EQ(to_row(failure_of(to_row(failure))), to_row(failure));
  EXPECT_EQ(met_signature_of(to_row("quick:1:broken:12", {"bvh", "s"})), "s");
}

TEST(Records, ThatNoRunStoresAreRefused) {
  for (const std::string fields : {"", "{", "[]", "1", "null", R"({"steps":"many"})"})
    EXPECT_THROW(trial_of({"trial", "q:1:broken:0", 0, fields}), StoreProblem) << fields;
  for (const std::string key : {"", "q", "q:1:broken:x", "q:1:broken:"})
    EXPECT_THROW(trial_of({"trial", key, 0, "{}"}), StoreProblem) << key;
  EXPECT_THROW(failure_of({"failure", "k", 0, "{}"}), StoreProblem);
}

TEST(Counts, TallyOfAStratum) {
  Tally tally;
  tally.add({"p:1:broken:0", "broken", 0, "HDUE", 5, 2, 1, 3, 10, 20, {{{"x", 1}}, {}, {}, {}}});
  tally.add({"p:1:broken:1", "broken", 1, "HHDH", 4, 1, 0, 0, 1, 2, {{{"x", 1}}, {}, {}, {}}});
  // A case that the detector's numbers do not hold is a trial of no configuration.
  tally.add({"p:1:broken:2", "broken", 2, "", 0, 0, 0, 0, 0, 0, {}});
  tally.add({"p:1:closed-generic:0", "closed-generic", 0, "H", 200, 1, 1, 1, 0, 0, {}});
  EXPECT_EQ(tally.counts.tags, (Counts{{"x", 2}}));
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

TEST(Shares, ReachTheWholeTogether) {
  CampaignPlan plan;
  plan.strata = {{"broken", 25, 0}, {"closed-generic", 2, 0}, {"closed-degenerate", 0, 0}};
  EXPECT_EQ(planned_trial_count(plan, 1), 27u);
  EXPECT_EQ(planned_trial_count(plan, 3), 10u);
  for (const std::uint64_t shares : {1u, 2u, 3u, 7u, 40u}) {
    EXPECT_GE(shares * share_of(25, shares), 25u);
    EXPECT_LT(shares * (share_of(25, shares) - 1), 25u);
    EXPECT_EQ(share_of(0, shares), 0u);
    // Seeds that follow one another judge every index once.
    std::set<std::uint64_t> indices;
    for (std::uint64_t seed = 5; seed < 5 + shares; ++seed) {
      for (std::uint64_t place = 0; place < share_of(25, shares); ++place)
        EXPECT_TRUE(indices.insert(trial_index(place, seed, shares)).second);
    }
    EXPECT_EQ(*indices.rbegin() + 1, indices.size());
  }
}

}  // namespace
}  // namespace assay::properties
