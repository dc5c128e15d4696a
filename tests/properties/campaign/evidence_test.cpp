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
  EXPECT_EQ(one.shard, other.shard);
  EXPECT_EQ(one.progress, other.progress);
  EXPECT_EQ(one.fields, other.fields);
}

TEST(Evidence, EveryKindSurvivesItsRow) {
  const Canary canary{"pair/x", "1/2", 7}, blind{"pair/x", "2/2", std::nullopt};
  expect_same_row(canary, read_back(canary).canaries.at(0));
  expect_same_row(blind, read_back(blind).canaries.at(0));
  const HarnessProblem problem{"1/2", "no worker", 7};
  expect_same_row(problem, read_back(problem).problems.at(0));
  auto proof = fault_proof("a/b", FaultStatus::open, true, {3, std::nullopt});
  proof.shrunk = ShrunkFault{{9, 8, 7}, {3, 2, 1}, 55};
  proof.known_vertices = 5;
  expect_same_row(proof, read_back(proof).faults.at(0));
  EXPECT_EQ(read_back(proof).faults.at(0).status, FaultStatus::open);
  const PowerSource source{"smoke", "built-in", 3, "p", "w", "g", "r"};
  expect_same_row(source, read_back(source).power.at(0));
  const World world{"square-2", "1/1", 3, 4, 5, 1, false, "pairs differ"};
  expect_same_row(world, read_back(world).worlds.at(0));
  const SearchedLane lane{"003", "1/2", 500, 2, 1, {"t at 1, moving, generic", "no contact"}};
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
  EXPECT_THROW(facts.take({"tea", "green", "1/1", 1, "{}"}), StoreProblem);
  auto row = to_row(Canary{"x", "1/1", 3});
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
  const World far{"w", "1/1", 1000, 1, 1, 0, false, std::nullopt},
      wrong{"w", "1/1", 1, 1, 1, 0, false, "c"};
  EXPECT_GT(to_row(wrong).progress, to_row(far).progress);
  // A problem goes before the word of the same time that there is none, and is over after a trial.
  const auto problem = [](const char* explanation, std::uint64_t trials) {
    return to_row(HarnessProblem{"1/1", explanation, trials}).progress;
  };
  EXPECT_GT(problem("no worker", 7), problem("", 7));
  EXPECT_GT(problem("", 8), problem("no worker", 7));
}

}  // namespace
}  // namespace assay::properties
