// L17: the oracle judges where the built-in detector lets a step stop. The steps are random small
// steps, and walks, in which each step starts where the last one stopped. ASSAY_CASES=1000000 runs
// more steps, ASSAY_WALKS=100 more walks of 1,000 steps each; ASSAY_SEED draws others.
#include <fmt/format.h>

#include "properties/campaign/phases/phases.h"
#include "properties/judging/agreement.h"
#include "properties/judging/step_measures.h"
#include "tests/asked.h"
#include "tests/properties/small_case.h"

namespace assay::properties {
namespace {

using detector::Culling;

Contract contract_within(double separation) {
  auto contract = contract_of({.separation = separation});
  contract.progress = built_in_progress;
  return contract;
}

detector::Detector detector_for(const corpus::Case& c, const detector::Options& options) {
  return std::move(detector::Detector::create(c.triangles, c.frames[0], options).value());
}

struct LimitTally {
  std::uint64_t steps = 0;
  LimitUse use;
};

// Asks the detector, and the oracle what it is worth. Where it stops.
detector::Positions judge_one(detector::Detector& detector, const corpus::Case& c,
                              const Contract& contract, LimitTally& tally) {
  const auto step = corpus::steps_of(c).front();
  const auto &from = start_of(c, step), &to = end_of(c, step);
  const auto limit = detector.limit(from, to);
  EXPECT_FALSE(limit.problem);
  const oracle::JudgeOptions options;
  const detector::SteppedMesh motion{from, to};
  const auto truth = judge_under(contract, motion, c.triangles, options);
  StepDiff diff;
  judge_limit(LimitAnswer{limit.share, limit.positions},
              {motion, c.triangles, options, truth, claims_on_limits, contract}, diff);
  for (const auto claim : diff.breaches) ADD_FAILURE() << name_of(claim) << ": " << c.id;
  diff.oracle_complete = true;
  tally.use += errors_of(diff).limits;
  ++tally.steps;
  return limit.positions;
}

// Prints what the steps came to, and expects that they are free and go far.
void expect_progress(const LimitTally& tally) {
  const auto& use = tally.use;
  fmt::print(
      "{} steps: {} free, {} with a contact ahead; used {:.4f} in the median, {:.4f} in 99 of 100, "
      "{:.4f} at worst; {} stalls\n",
      tally.steps, use.free, use.contact, use.share(0.5), use.share(0.01), use.share(0),
      use.stalled());
  for (const auto& [cause, count] : use.stalls)
    fmt::print("  stalled {} times: {}\n", count, cause);
  EXPECT_EQ(use.cut, 0u);
  EXPECT_GT(use.contact, tally.steps / 10);
  EXPECT_LE(use.stalled() * 10'000, tally.steps + 10'000);
}

TEST(LimitsOfTheBuiltIn, L17_RandomStepsAreFreeAndGoFar) {
  const std::uint64_t cases = tests::asked("ASSAY_CASES", 1500);
  const std::uint64_t seed = tests::asked("ASSAY_SEED", 2017);
  LimitTally tally;
  for (std::uint64_t i = 0; i < cases && !testing::Test::HasFailure(); ++i) {
    const auto c = test::small_case(seed, i);
    // By turns with and without a separation, with views and without.
    const double separation = i % 4 == 0 ? 0x1p-6 : 0;
    const auto culling = separation > 0 || i % 2 == 0 ? Culling::bvh : Culling::automatic;
    auto detector = detector_for(c, {.culling = culling, .separation = separation});
    judge_one(detector, c, contract_within(separation), tally);
  }
  expect_progress(tally);
}

TEST(LimitsOfTheBuiltIn, L17_WalksStayFreeAndMove) {
  const std::uint64_t walks = tests::asked("ASSAY_WALKS", 0);
  const std::uint64_t seed = tests::asked("ASSAY_SEED", 2018);
  const auto& kinds = all_values<WalkKind>;
  const std::uint64_t count = walks > 0 ? walks : 2 * kinds.size();
  LimitTally tally;
  for (std::uint64_t i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const auto contract = contract_within(i % 3 == 0 ? 0x1p-8 : 0);
    const auto kind = kinds[i % kinds.size()];
    std::optional<detector::Detector> detector;
    const int steps = walks > 0 ? steps_of_a_walk : 60;
    const auto c = walk(kind, seed + i, steps, contract, [&](const corpus::Case& step) {
      if (!detector)
        detector = detector_for(step, {.culling = Culling::bvh, .separation = contract.separation});
      return std::optional(judge_one(*detector, step, contract, tally));
    });
    EXPECT_EQ(c.script.size(), static_cast<std::size_t>(steps));
    EXPECT_EQ(c.frames.size(), 2 * c.script.size());
  }
  expect_progress(tally);
}

TEST(Walks, AreOfTheirSeedAlone) {
  const auto stays = [](const corpus::Case& step) { return std::optional(step.frames[0]); };
  for (const auto kind : all_values<WalkKind>) {
    const auto c = walk(kind, 3, 10, {}, stays);
    EXPECT_EQ(c.id, name_of(kind));
    EXPECT_EQ(c.frames, walk(kind, 3, 10, {}, stays).frames);
    EXPECT_NE(c.frames, walk(kind, 4, 10, {}, stays).frames);
    EXPECT_TRUE(judge_under({}, {c.frames[0], c.frames[0]}, c.triangles).pairs.empty())
        << c.id << " starts in contact";
    const auto ended = walk(kind, 3, 10, {}, [&, n = 0](const corpus::Case& step) mutable {
      return ++n < 4 ? stays(step) : std::nullopt;
    });
    EXPECT_EQ(ended.script.size(), 4u) << "the step that has no answer is one of it";
    Contract small;
    small.largest = 1;
    EXPECT_EQ(walk(kind, 3, 10, small, stays).script.size(), 0u) << "beyond the contract";
  }
}

}  // namespace
}  // namespace assay::properties
