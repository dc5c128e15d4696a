// Every kind of evidence survives its row, and what no run stores is refused.
#include "properties/campaign/ledger/evidence.h"

#include "tests/properties/campaign/good_findings.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using test::fault_proof;

template <class T>
EvidenceFacts read_back(const T& evidence) {
  EvidenceFacts facts;
  facts.take(to_row(evidence));
  return facts;
}

// The row of what was read from a row is that row.
template <class T>
void expect_same_row(const T& evidence, const T& back) {
  const auto one = to_row(evidence), other = to_row(back);
  EXPECT_EQ(one.kind, other.kind);
  EXPECT_EQ(one.key, other.key);
  EXPECT_EQ(one.progress, other.progress);
  EXPECT_EQ(one.fields, other.fields);
}

// Who took over a proof may have it from the very run that stands beside it.
TEST(Evidence, CasesOfAProofThatWasTakenOverDoNotCountTwice) {
  EvidenceFacts own, taken;
  own.faults = taken.faults = {fault_proof("a/b", FaultStatus::planted, true, {3})};
  taken.power = {{"smoke", "built-in", 3, "p", "w", "g", "r"}};
  const auto cases = own.faults[0].cases;
  for (const bool is_first : {true, false}) {
    EvidenceFacts sum = is_first ? own : taken;
    sum.add(is_first ? taken : own);
    sum.add(taken);
    EXPECT_EQ(sum.faults.at(0).cases, cases);
    EXPECT_TRUE(sum.power.empty());
  }
  taken.add(taken);
  EXPECT_EQ(taken.power.size(), 1u);
  own.add(own);
  EXPECT_EQ(own.faults.at(0).cases, 2 * cases);
}

TEST(Evidence, EveryKindSurvivesItsRow) {
  const Canary canary{"pair/x", 7}, blind{"pair/x", std::nullopt};
  expect_same_row(canary, read_back(canary).canaries.at(0));
  expect_same_row(blind, read_back(blind).canaries.at(0));
  const HarnessProblem problem{"no worker", 7};
  expect_same_row(problem, read_back(problem).problems.at(0));
  auto proof = fault_proof("a/b", FaultStatus::open, true, {3, std::nullopt});
  proof.shrunk = ShrunkFault{{9, 8, 7}, {3, 2, 1}, 55};
  proof.known_vertices = 5;
  expect_same_row(proof, read_back(proof).faults.at(0));
  EXPECT_EQ(read_back(proof).faults.at(0).status, FaultStatus::open);
  const PowerSource source{"smoke", "built-in", 3, "p", "w", "g", "r"};
  expect_same_row(source, read_back(source).power.at(0));
  const World world{"square-2", 3, 4, 5, 1, false, "pairs differ"};
  expect_same_row(world, read_back(world).worlds.at(0));
  const SearchedLane lane{"003", 500, 480, 2, 1, {"t at 1, moving, generic", "no contact"}};
  expect_same_row(lane, read_back(lane).search.at(0));
  const Asked asked{{"harness", "speed"}, true};
  expect_same_row(asked, *read_back(asked).asked);
  const Versions versions{"0.2.0", std::nullopt, "CGAL 5.5.1"};
  expect_same_row(versions, *read_back(versions).versions);
  const Paths paths{"out", "lib.so"};
  expect_same_row(paths, *read_back(paths).paths);
  const InputDigests inputs{"c"};
  expect_same_row(inputs, *read_back(inputs).inputs);
  const CorpusRow corpus{
      "curated cases",   "bvh", 1, 2, 3, 4, 5, 6, {{"A1", "s", "w"}}, {{"A2", "", "no verdict"}},
      {1, 2, 3, 4, 5, 6}};
  expect_same_row(corpus, read_back(corpus).corpus.at(0));
  const SelfTestRow row{"line-3", 10, 3, 0, 1, true};
  expect_same_row(row, read_back(row).self_test.at(0));
  const SpeedFigure figure{"exact-over-double", 1.25, 1, 1.5, {1, 1.5}};
  expect_same_row(figure, read_back(figure).speed.at(0));
  const Issued issued{"2026-01-31T12:00:00Z", 4.5};
  expect_same_row(issued, *read_back(issued).issued);
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

TEST(Evidence, AFaultIsFoundByItsCuratedCaseOrByARandomOne) {
  const auto found = [](bool curated, std::vector<std::optional<std::uint64_t>> needed) {
    return fault_proof("x", FaultStatus::planted, curated, std::move(needed)).found();
  };
  EXPECT_TRUE(found(true, {std::nullopt, std::nullopt}));
  EXPECT_TRUE(found(false, {7, std::nullopt}));
  EXPECT_FALSE(found(false, {std::nullopt, std::nullopt}));
  EXPECT_FALSE(found(false, {}));
}

TEST(Evidence, TheMedianCountsWhatWasNotFoundAsLast) {
  const auto median = [](std::vector<std::optional<std::uint64_t>> needed) {
    return fault_proof("x", FaultStatus::planted, false, std::move(needed)).median();
  };
  EXPECT_EQ(median({30, 10, 20}), 20u);
  EXPECT_EQ(median({std::nullopt, 10, 20}), 20u);
  EXPECT_FALSE(median({std::nullopt, 10, std::nullopt}));
  EXPECT_FALSE(median({}));
}

TEST(Evidence, TheFartherOfTwoCountsMore) {
  auto cut = fault_proof("x", FaultStatus::planted, false, {5, std::nullopt});
  cut.time_over = true;
  const auto whole = fault_proof("x", FaultStatus::planted, false, {5, std::nullopt});
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
  sum.faults = {fault_proof("a", FaultStatus::planted, false, {5, std::nullopt, std::nullopt})};
  other.faults = {fault_proof("a", FaultStatus::planted, true, {2, 7, std::nullopt}),
                  fault_proof("b", FaultStatus::planted, false, {3})};
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
  sum.self_test = {{"line-3", 10, 3, 0, 1, true}};
  sum.worlds = {{"w", 5, 1, 1, 0, false, std::nullopt}};
  sum.canaries = {{"c", 7}};
  sum.versions = Versions{"1", std::nullopt, "l"};
  EvidenceFacts other = sum;
  other.worlds[0].classes = 9;
  sum.add(other);
  EXPECT_EQ(sum.self_test.size(), 1u);
  EXPECT_EQ(sum.canaries.size(), 2u);
  ASSERT_EQ(sum.worlds.size(), 1u);
  EXPECT_EQ(sum.worlds[0].classes, 9u);
  // What they do not come to alike is not lost.
  other.self_test[0].contradictions = 1;
  sum.add(other);
  EXPECT_EQ(sum.self_test.size(), 2u);
  other.versions->assay = "2";
  EXPECT_THROW(sum.add(other), StoreProblem);
}

TEST(Evidence, OfTwoRunsThatTookOverProofsTheProofsAreTheSame) {
  EvidenceFacts sum;
  sum.power = {{"smoke", "built-in", 3, "p", "w", "g", "r"}};
  sum.faults = {fault_proof("a", FaultStatus::planted, false, {5})};
  const EvidenceFacts other = sum;
  sum.add(other);
  EXPECT_EQ(sum.power.size(), 1u);
  EXPECT_EQ(sum.faults.at(0).cases, 100u);
  auto changed = other;
  changed.faults[0].needed = {6};
  EXPECT_THROW(EvidenceFacts(sum).add(changed), StoreProblem);
  changed = other;
  changed.power[0].seed = 4;
  EXPECT_THROW(EvidenceFacts(sum).add(changed), StoreProblem);
}

}  // namespace
}  // namespace assay::properties
