// A relation of a case under a contract, and what a contract leaves out by itself.
#include "properties/judging/case_check.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/judged_run.h"
#include "properties/judging/trial.h"
#include "tests/curated_cases.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// A corner of a tube passes through its own 2-ring, and then meets the far side.
corpus::Case ignored_contact() { return tests::curated_case("F_ignored_contact"); }

TEST(CountedCase, FactsSpeakOfAllPairsAndOfThoseThatCount) {
  auto c = ignored_contact();
  EXPECT_EQ(check_case(c).failed, std::vector<std::string>{});
  EXPECT_EQ(check_case(c, detector::Culling::bvh).failed, std::vector<std::string>{});
  c.counted->steps[0].pairs->pop_back();
  const auto failed = check_case(c, detector::Culling::bvh).failed;
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_NE(failed[0].find("step 1: of what counts: "), std::string::npos) << failed[0];
}

TEST(CountedCase, OneThatCannotBeToldSeesNoRelation) {
  const auto c = ignored_contact();
  EXPECT_TRUE(contracted(c, {})->counted);
  EXPECT_FALSE(contracted(c, {.takes_relations = false})->counted);
}

// The bodies name triangles, whoever cannot be told which of them meet.
TEST(CountedCase, OneThatCannotBeToldKeepsTheBodies) {
  auto c = ignored_contact();
  c.counted->pairs.body.assign(static_cast<std::size_t>(c.frames[0].rows()), 0);
  c.counted->pairs.apart = {{0, 0}};
  const auto seen = contracted(c, {.takes_relations = false});
  ASSERT_TRUE(seen && seen->counted);
  EXPECT_TRUE(seen->counted->pairs.count_all());
  EXPECT_EQ(seen->counted->pairs.body, c.counted->pairs.body);
}

TEST(CountedCase, PlacesAtRestAreRoundedAsCoordinatesAre) {
  auto c = ignored_contact();
  c.counted->pairs.rest_distance = 0.1;
  c.counted->pairs.rest = corpus::points_of(c.frames[0]);
  c.counted->pairs.rest[0][0] = 0.3;
  const Contract floats = {.coordinates = Coordinates::float32};
  const auto seen = contracted(c, floats);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->counted->pairs.rest_distance, static_cast<double>(0.1f));
  EXPECT_EQ(seen->counted->pairs.rest[0][0], static_cast<double>(0.3f));
  EXPECT_TRUE(seen->counted->steps.empty()) << "facts of another relation";
  c.counted->pairs.rest[0][0] = 1e300;
  EXPECT_FALSE(contracted(c, floats));
}

TEST(CountedCase, StepsKeepTheirFacts) {
  auto c = ignored_contact();
  c.frames.push_back(c.frames[1]);
  c.counted->steps.push_back({detector::Answer::free, {}, {}, {}, {}});
  const auto last = with_steps(c, {1});
  ASSERT_EQ(last.counted->steps.size(), 1u);
  EXPECT_EQ(last.counted->steps[0].answer, detector::Answer::free);
}

// What is too near at rest goes by the frame that a detector is made from.
TEST(CountedCase, StepsStayWithTheMeshAtRest) {
  auto c = ignored_contact();
  c.frames = {c.frames[1], c.frames[0], c.frames[1]};
  c.script = {{0, 1, true}, {1, 2, true}};
  EXPECT_EQ(with_steps(c, {1}).frames.front(), c.frames[1]);
  const auto alone = with_steps(c, {1}, {.rest_distance = 0.1});
  EXPECT_EQ(alone.frames.front(), c.frames[0]);
  EXPECT_EQ(start_of(alone, corpus::steps_of(alone).front()), c.frames[1]);
}

// A contract that leaves out what the case's relation leaves out: the same pairs count, and the
// others are left out.
TEST(CountedCase, AContractLeavesOutWhatARelationDoes) {
  const auto c = ignored_contact();
  ASSERT_TRUE(c.counted->pairs.apart.empty() && c.counted->pairs.triangle_pairs.empty());
  Contract contract;
  contract.counts = c.counted->pairs.level;
  contract.rings = c.counted->pairs.rings;
  contract.rest_distance = c.counted->pairs.rest_distance;
  ASSERT_TRUE(contract.tests_part());
  const auto counted = judge_case(c)[0];
  auto all = c;
  all.counted.reset();
  const auto judged = judge_case(all, contract)[0];
  EXPECT_EQ(judged.pairs.size(), judge_case(all)[0].pairs.size());
  const auto truth = truth_of(all, judged, contract);
  ASSERT_EQ(truth.pairs.size(), counted.pairs.size());
  EXPECT_EQ(truth.first->time, counted.first);
  EXPECT_EQ(truth.left_out.size(), judged.pairs.size() - counted.pairs.size());
  EXPECT_GT(truth.left_out.size(), 0u);
}

// Where a start must be free, or apart, only pairs that count are looked at.
TEST(CountedCase, AStartIsFreeOfWhatCounts) {
  corpus::Case c;
  c.triangles.resize(2, 3);
  c.triangles << 0, 1, 2, 3, 4, 5;
  detector::Positions x(6, 3);
  x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, 2, 1, 0, 1, 2, 0;
  c.frames = {x, x};
  const Contract free_start = {.start = StartRule::free};
  EXPECT_FALSE(contracted(c, free_start));
  c.counted.emplace();
  c.counted->pairs.triangle_pairs = {{0, 1}};
  EXPECT_TRUE(contracted(c, free_start));
  EXPECT_FALSE(contracted(c, {.start = StartRule::free, .takes_relations = false}));
  c.counted.reset();
  EXPECT_TRUE(contracted(c, {.start = StartRule::free, .rest_distance = 1}));
}

TEST(CountedCase, ABodyNamesItsTriangles) {
  detector::CountedPairs pairs;
  detector::Triangles triangles(3, 3);
  triangles << 0, 1, 2, 3, 4, 5, 0, 2, 6;
  EXPECT_EQ(BodyNames(nullptr, triangles).text({1, 2}), "");
  EXPECT_EQ(BodyNames(&pairs, triangles).text({1, 2}), "");
  pairs.body = {0, 0, 0, 1, 1, 1, 0};
  EXPECT_EQ(BodyNames(&pairs, triangles).text({1, 2}),
            " (triangle 0 of body 1 and triangle 1 of body 0)");
}

}  // namespace
}  // namespace assay::properties
