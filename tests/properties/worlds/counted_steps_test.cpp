// L19: what counts. A plain loop, the oracle and the detector agree on random steps with random
// relations.
#include "tests/properties/worlds/counted_steps.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "corpus/cases/case_file.h"
#include "detector/assembly.h"
#include "detector/search/pair_relation.h"
#include "tests/asked.h"

namespace assay::properties::test {
namespace {

using tests::asked;

// ASSAY_SEED and ASSAY_CASES replay other cases; ASSAY_CASE runs a single one.
template <class Disagreement>
void expect_agreement(const char* test, std::uint64_t usual, const Disagreement& disagree) {
  const std::uint64_t seed = asked("ASSAY_SEED", 20119), cases = asked("ASSAY_CASES", usual),
                      only = asked("ASSAY_CASE", cases);
  CountedTally tally;
  for (std::uint64_t i = 0; i < cases; ++i) {
    if (only != cases && i != only) continue;
    const auto wrong = disagree(make_counted_steps(seed, i), i, tally);
    ASSERT_FALSE(wrong) << *wrong << "\nreplay: ASSAY_SEED=" << seed << " ASSAY_CASE=" << i
                        << " ctest --preset law -R " << test;
  }
  std::printf(
      "%llu steps, seed %llu: %llu collide, %llu pairs count; %llu in contact do not, in %llu "
      "steps, "
      "%llu of which collide\n",
      static_cast<unsigned long long>(tally.steps), static_cast<unsigned long long>(seed),
      static_cast<unsigned long long>(tally.collisions),
      static_cast<unsigned long long>(tally.pairs), static_cast<unsigned long long>(tally.ignored),
      static_cast<unsigned long long>(tally.with_ignored),
      static_cast<unsigned long long>(tally.with_both));
  if (only != cases) return;
  EXPECT_GT(tally.with_ignored, tally.steps / 10);
  EXPECT_GT(tally.with_both, tally.steps / 20);
  EXPECT_GT(tally.steps - tally.collisions, tally.steps / 20);
}

TEST(CountedSteps, L19_PlainLoopOracleAndDetectorAgree) {
  expect_agreement(
      "PlainLoopOracleAndDetectorAgree", 1000,
      [](const CountedSteps& steps, auto, auto& tally) { return disagreement(steps, tally); });
}

TEST(CountedSteps, L16_L19_TheyAgreeWithinASeparationToo) {
  constexpr double separations[] = {0.5, 1, 2, 0x1p-30, 1.4142135623730951};
  expect_agreement("TheyAgreeWithinASeparationToo", 150,
                   [&](const CountedSteps& steps, std::uint64_t i, auto& tally) {
                     return disagreement_within(steps, separations[i % 5], tally);
                   });
}

// A detector that drops contacts that do not count before the closure: only what counts joins H.
class DropsBeforeTheClosure : public detector::PairRule {
 public:
  DropsBeforeTheClosure(const detector::CountedPairs& counted, const detector::Topology& mesh)
      : mesh_(mesh), relation_(&counted, mesh) {}
  bool joins_closure(const detector::TrianglePair& pair, std::int32_t) const override {
    return relation_.counts(mesh_, pair);
  }

 private:
  const detector::Topology mesh_;
  const detector::PairRelation relation_;
};

// A corner of a tube passes through its own 2-ring, and then meets the far side from the inside.
TEST(CountedSteps, L19_AnIgnoredContactTurnsTriangles) {
  const auto read = corpus::read_case(ASSAY_SOURCE_DIR "/corpus/curated/F_ignored_contact.json");
  ASSERT_TRUE(read) << read.error().message;
  const corpus::Case& c = read.value();
  ASSERT_TRUE(c.counted && c.counted->steps.size() == 1);
  const corpus::ExpectedStep& expected = c.counted->steps[0];
  const CountedSteps steps = {c.triangles, c.frames, c.counted->pairs};
  CountedTally tally;
  EXPECT_EQ(disagreement(steps, tally), std::nullopt);
  EXPECT_GT(tally.ignored, 0u);

  detector::Options options;
  options.culling = detector::Culling::view_point;
  options.counted = &c.counted->pairs;
  auto right = detector::Detector::create(c.triangles, c.frames[0], options);
  const auto result = right.value().step(c.frames[0], c.frames[1]);
  EXPECT_EQ(result.answer, expected.answer);
  EXPECT_EQ(result.first, *expected.first_time);
  ASSERT_EQ(result.pairs.size(), expected.pairs->size());
  for (std::size_t i = 0; i < result.pairs.size(); ++i) {
    EXPECT_EQ(result.pairs[i].pair, (*expected.pairs)[i].pair);
    EXPECT_EQ(result.pairs[i].time, (*expected.pairs)[i].time);
  }

  detector::Stages stages = detector::standard_stages(options);
  stages.pair_rule = std::make_shared<DropsBeforeTheClosure>(
      c.counted->pairs, detector::make_topology(c.triangles, c.frames[0].rows()));
  auto wrong = detector::assemble(c.triangles, c.frames[0], options, std::move(stages));
  EXPECT_EQ(wrong.value().step(c.frames[0], c.frames[1]).answer, detector::Answer::free);
}

}  // namespace
}  // namespace assay::properties::test
