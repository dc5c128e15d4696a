// Every kind of evidence can be stored as a row and read back, and rows that no run stores are
// refused.
#include "properties/campaign/ledger/evidence.h"

#include "properties/campaign/ledger/tally.h"
#include "properties/campaign/phases/phases.h"
#include "properties/campaign/trials/trials.h"
#include "tests/properties/campaign/good_findings.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using test::fault_proof;

// The row of what was read from a row is that row.
template <class T, class Held>
void expect_survives(const T& evidence, Held EvidenceFacts::*list) {
  const auto one = to_row(evidence);
  EvidenceFacts facts;
  facts.take(one);
  const auto other = [&] {
    if constexpr (requires { (facts.*list).at(0); })
      return to_row((facts.*list).at(0));
    else
      return to_row((facts.*list).value());
  }();
  EXPECT_EQ(one, other) << one.fields << "\n" << other.fields;
}

const PowerSource power{"smoke", "built-in", 3, "p", "w", "g", "r"};

// Who took over a proof may have it from the very run that stands beside it.
TEST(Evidence, CasesOfAProofThatWasTakenOverDoNotCountTwice) {
  EvidenceFacts own, taken;
  own.faults = taken.faults = {fault_proof("a/b", FaultStatus::planted, true, {3})};
  taken.power = {power};
  const auto cases = own.faults[0].cases;
  for (const bool is_first : {true, false}) {
    EvidenceFacts sum = is_first ? own : taken;
    sum.add(is_first ? taken : own);
    sum.add(taken);
    EXPECT_EQ(sum.faults.at(0).cases, cases);
    EXPECT_TRUE(sum.power.empty());
  }
  for (const bool is_power : {true, false}) {
    auto changed = taken;
    if (is_power)
      changed.power[0].seed = 4;
    else
      changed.faults[0].needed = {6};
    EXPECT_THROW(EvidenceFacts(taken).add(changed), StoreProblem) << is_power;
  }
  taken.add(taken);
  EXPECT_EQ(taken.power.size(), 1u);
  EXPECT_EQ(taken.faults.at(0).cases, cases);
  own.add(own);
  EXPECT_EQ(own.faults.at(0).cases, 2 * cases);
}

TEST(Evidence, EveryKindSurvivesItsRow) {
  expect_survives(Canary{"pair/x", 7}, &EvidenceFacts::canaries);
  expect_survives(Canary{"pair/x", std::nullopt}, &EvidenceFacts::canaries);
  expect_survives(HarnessProblem{"no worker", 7}, &EvidenceFacts::problems);
  auto proof = fault_proof("a/b", FaultStatus::open, true, {3, std::nullopt});
  proof.known_vertices = 5;
  expect_survives(proof, &EvidenceFacts::faults);
  EvidenceFacts facts;
  facts.take(to_row(proof));
  EXPECT_EQ(facts.faults.at(0).status, FaultStatus::open);
  expect_survives(power, &EvidenceFacts::power);
  expect_survives(World{"square-2", 3, 4, 5, 1, false, "pairs differ"}, &EvidenceFacts::worlds);
  expect_survives(VerbRequest{{"harness", "speed"}, true}, &EvidenceFacts::request);
  expect_survives(Versions{"0.2.0", std::nullopt, "CGAL 5.5.1", "c"}, &EvidenceFacts::versions);
  JudgedSource judged{Source::own, "input", "bvh", 1, 2, 3, 4, 5, 6, 7, 8, false};
  judged.failed = {{"A1", "s", "w"}};
  judged.open = {{"A2", "", "no verdict"}};
  judged.extremes = {1, 2, 3, 4, 5, 6};
  judged.threads = {1, 2};
  judged.judged = {{1, 2, true}};
  judged.causes = {"t at 1, moving, generic", "no contact"};
  expect_survives(judged, &EvidenceFacts::sources);
  const SpeedFigure figure{"exact-over-double", 1.25, 1, 1.5, {1, 1.5}};
  expect_survives(figure, &EvidenceFacts::speed);
  expect_survives(Issuance{"out", "lib.so", "", "", "2026-01-31T12:00:00Z", 4.5},
                  &EvidenceFacts::issued);
}

TEST(Evidence, WhatNoRunStoresIsRefused) {
  EvidenceFacts facts;
  EXPECT_THROW(facts.take({"tea", "green", 1, "{}"}), StoreProblem);
  auto row = to_row(Canary{"x", 3});
  for (const char* wrong : {"", "{", "[]", "{}", R"({"found_after": "soon"})"}) {
    row.fields = wrong;
    EXPECT_THROW(facts.take(row), StoreProblem) << wrong;
  }
  auto proof = to_row(fault_proof("a", FaultStatus::planted, true));
  proof.fields.replace(proof.fields.find("planted"), 7, "planned");
  EXPECT_THROW(facts.take(proof), StoreProblem);
}

constexpr auto never = std::nullopt;

FaultProof planted(std::vector<std::optional<std::uint64_t>> needed, bool curated = false,
                   const std::string& name = "a") {
  return fault_proof(name, FaultStatus::planted, curated, std::move(needed));
}

// By its curated case or by a random one. In the median what was not found counts as last.
TEST(Evidence, OfAFaultItIsToldWhetherItWasFoundAndAfterHowManyCases) {
  EXPECT_TRUE(planted({never, never}, true).is_found());
  EXPECT_TRUE(planted({7, never}).is_found());
  EXPECT_FALSE(planted({never, never}).is_found());
  EXPECT_FALSE(planted({}).is_found());
  EXPECT_EQ(planted({30, 10, 20}).median(), 20u);
  EXPECT_EQ(planted({never, 10, 20}).median(), 20u);
  EXPECT_FALSE(planted({never, 10, never}).median());
  EXPECT_FALSE(planted({}).median());
}

TEST(Evidence, TheFartherOfTwoCountsMore) {
  const auto whole = planted({5, never});
  auto cut = whole;
  cut.time_over = true;
  EXPECT_GT(to_row(whole).progress, to_row(cut).progress);
  const World far{"w", 1000, 1, 1, 0, false, std::nullopt}, wrong{"w", 1, 1, 1, 0, false, "c"};
  EXPECT_GT(to_row(wrong).progress, to_row(far).progress);
  // A problem goes before the word of the same time that there is none, and is over after a trial.
  const auto problem = [](const char* explanation, std::uint64_t trials) {
    return to_row(HarnessProblem{explanation, trials}).progress;
  };
  EXPECT_GT(problem("no worker", 7), problem("", 7));
  EXPECT_GT(problem("", 8), problem("no worker", 7));
}

TEST(Evidence, OfTwoRunsTheCasesOfAFaultAddUp) {
  EvidenceFacts sum, other;
  sum.faults = {planted({5, never, never})};
  other.faults = {planted({2, 7, never}, true), planted({3}, false, "b")};
  sum.add(other);
  ASSERT_EQ(sum.faults.size(), 2u);
  const auto& a = sum.faults[0];
  EXPECT_EQ(a.cases, 200u);
  EXPECT_EQ(a.needed, (std::vector<std::optional<std::uint64_t>>{5, 107, std::nullopt}));
  EXPECT_TRUE(a.curated);
  EXPECT_FALSE(a.time_over);
  other.faults[0].time_over = true;
  sum.add(other);
  EXPECT_TRUE(sum.faults[0].time_over);
}

TEST(Evidence, OfTwoRunsWhatBothDoAlikeCountsOnce) {
  EvidenceFacts sum;
  sum.sources = {{.source = Source::self_test, .input = "line-3", .cases = 10},
                 {.source = Source::search, .input = "001", .planned = 500, .cases = 480}};
  sum.worlds = {{"w", 5, 1, 1, 0, false, std::nullopt}};
  sum.canaries = {{"c", 7}};
  sum.versions = Versions{"1", std::nullopt, "l"};
  EvidenceFacts other = sum;
  other.worlds[0].classes = 9;
  sum.add(other);
  EXPECT_EQ(sum.rows_of(Source::self_test).size(), 1u);
  EXPECT_EQ(sum.sum_of(Source::search).cases, 960u);
  EXPECT_EQ(sum.canaries.size(), 2u);
  ASSERT_EQ(sum.worlds.size(), 1u);
  EXPECT_EQ(sum.worlds[0].classes, 9u);
  // What they do not come to alike is not lost.
  other.sources[0].defects = 1;
  sum.add(other);
  EXPECT_EQ(sum.rows_of(Source::self_test).size(), 2u);
  other.versions->assay = "2";
  EXPECT_THROW(sum.add(other), StoreProblem);
}

// Records of trials, their counts and sums, and the shares of a campaign.

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
  // What is 0 takes no room.
  TrialRecord small;
  small.id = "q:1:broken:0";
  small.outcomes = "H";
  EXPECT_EQ(to_row(small).fields, R"({"outcomes":"H"})");
  const FailureRecord failure{Source::own,    "A1",     "bvh",    "L3_X", "all-pairs",
                              "missing pair", "t at 0", "what",   "m",    "small",
                              "of it",        true,     "printed"};
  const auto kept = to_row(failure);
  EXPECT_EQ(to_row(failure_of(kept)), kept);
  EXPECT_EQ(kept.key, "corpus/A1, bvh, law L3_X");
  EXPECT_EQ(failure.signature(), "law L3_X, all-pairs: missing pair, t at 0");
  EXPECT_EQ(met_row(failure).key, kept.key);
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
  EXPECT_EQ(broken.by_configuration, (std::vector<StratumTally::Outcomes>{
                                         {2, 0, 0, 0}, {1, 1, 0, 0}, {0, 1, 1, 0}, {1, 0, 0, 1}}));
  EXPECT_EQ(broken.sizes, (std::map<int, std::uint64_t>{{-1, 1}, {2, 2}}));
  EXPECT_EQ(broken.contacts, (std::map<int, std::uint64_t>{{-1, 2}, {1, 1}}));
  EXPECT_EQ(tally.strata.at("closed-generic").sizes, (std::map<int, std::uint64_t>{{7, 1}}));
  std::string letters;
  for (const auto outcome : {Outcome::holds, Outcome::defect, Outcome::undecided, Outcome::error})
    letters += letter_of(outcome);
  EXPECT_EQ(letters, "HDUE");
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
    for (std::uint64_t seed = 5; seed < 5 + shares; ++seed)
      for (std::uint64_t place = 0; place < share_of(25, shares); ++place)
        EXPECT_TRUE(indices.insert(trial_index(place, seed, shares)).second);
    EXPECT_EQ(*indices.rbegin() + 1, indices.size());
  }
}

}  // namespace
}  // namespace assay::properties
