// The result of a plug-in: how it is read, and which violations of the rules are found in it.
#include "properties/worker/plugin/plugin_host.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using detector::Answer;

constexpr std::int32_t triangle_count = 4;

assay_result collision() {
  assay_result raw = {};
  raw.answer = ASSAY_COLLISION;
  raw.first_lo = raw.first_hi = .5;
  return raw;
}

TEST(PluginResult, PairsAreOrderedAndEachIsThereOnce) {
  const std::array<std::int32_t, 6> pairs = {3, 1, 0, 2, 1, 3};
  const std::array<double, 6> times = {.75, .75, .5, .5, .625, .625};
  assay_result raw = collision();
  raw.pairs = pairs.data();
  raw.pair_times = times.data();
  raw.pair_count = 3;
  const auto result = step_result(raw, triangle_count);
  ASSERT_TRUE(result);
  EXPECT_EQ(result.value().answer, Answer::collision);
  ASSERT_EQ(result.value().pairs.size(), 2u);
  EXPECT_EQ(result.value().pairs[0].pair, (detector::TrianglePair{0, 2}));
  EXPECT_EQ(result.value().pairs[1].pair, (detector::TrianglePair{1, 3}));
  EXPECT_EQ(result.value().pairs[1].time, (detector::TimeEnclosure{.625, .625}));
}

void expect_broken(const assay_result& raw, const std::string& why) {
  const auto result = step_result(raw, triangle_count);
  ASSERT_FALSE(result) << why;
  EXPECT_EQ(result.error().message, why);
}

// A refusal for size is a problem of its own kind.
TEST(PluginResult, WhatThePlugInSaysItselfIsNoBrokenRule) {
  assay_result raw = {};
  raw.answer = ASSAY_ERROR;
  expect_broken(raw, "an error without a message");
  raw.message = "too thin";
  expect_broken(raw, "too thin");
  raw.answer = ASSAY_BEYOND_CAPACITY;
  expect_broken(raw, "refused: capacity: too thin");
  EXPECT_EQ(step_result(raw, triangle_count).error().kind, ProblemKind::beyond_capacity);
}

TEST(PluginResult, BrokenRulesAreNamed) {
  assay_result raw = collision();
  raw.first_hi = 2;
  expect_broken(raw, "its first time, [0.5, 2], is no interval in [0, 1]");
  raw = collision();
  raw.pair_count = 1;
  expect_broken(raw, "pairs are counted but not given");
  const std::array<std::int32_t, 2> pair = {0, 1};
  const std::array<double, 2> no_time = {std::numeric_limits<double>::quiet_NaN(), 1};
  raw.pairs = pair.data();
  raw.pair_times = no_time.data();
  expect_broken(raw, "the time of pair 0, [nan, 1], is no interval in [0, 1]");
  const std::array<std::int32_t, 2> outside = {0, triangle_count};
  raw.pairs = outside.data();
  expect_broken(raw, "pair 0 names no two triangles");
  raw.answer = ASSAY_FREE;
  expect_broken(raw, "answers free and gives pairs");
  raw.answer = 99;
  expect_broken(raw, "answer 99 is no answer of the interface");
}

// A limiter's answer for one vertex that goes from `from` to `to` along each axis.
class LimitResult : public testing::Test {
 protected:
  using Positions = detector::Positions;
  static Positions at(double x) { return Positions::Constant(1, 3, x); }

  Expected<LimitAnswer> read(double share, const double* positions = nullptr) const {
    const Positions way =
        contract.motion == MotionGiven::ends ? at(to) : displacement(at(from), at(to));
    return limit_answer({share, positions}, claims, contract, at(from),
                        round_to(at(to), contract.coordinates), way);
  }
  double place(double share) const { return read(share).value().positions(0, 0); }

  double from = 0.1, to = 0.7;
  Claims claims = {Claim::whole};
  Contract contract;
};

TEST_F(LimitResult, L17_AShareIsComputedAsItsCallerComputesIt) {
  constexpr double share = 0.3;
  contract.limit_gives = LimitGives::start_plus;
  EXPECT_EQ(place(share), from + share * (to - from));
  contract.limit_gives = LimitGives::blend;
  EXPECT_EQ(place(share), (1 - share) * from + share * to);
  contract.coordinates = Coordinates::float32;
  const auto f = static_cast<float>(from = 0.1f), t = static_cast<float>(to = 0.7f),
             s = static_cast<float>(share);
  EXPECT_EQ(place(share), static_cast<double>((1 - s) * f + s * t));
  contract.limit_gives = LimitGives::start_plus;
  EXPECT_EQ(place(share), static_cast<double>(f + s * (t - f)));
  EXPECT_NE(place(share), from + share * (to - from));
  // A displacement is added as it was given; share 1 is the rounding of its exact end.
  contract.motion = MotionGiven::displacement;
  const float way = static_cast<float>(to - from);
  EXPECT_EQ(place(share), static_cast<double>(f + s * way));
  to = from + static_cast<double>(way);
  EXPECT_EQ(place(1), static_cast<double>(static_cast<float>(to)));
  // Share 1 is the end in every bit.
  contract = {};
  contract.limit_gives = LimitGives::start_plus;
  from = 0x1p60, to = 0.1;
  ASSERT_NE(from + (to - from), to);
  EXPECT_EQ(place(1), to);
}

TEST_F(LimitResult, BrokenRulesAreNamed) {
  const auto expect_broken = [&](double share, const std::string& why) {
    const auto answer = read(share);
    ASSERT_FALSE(answer) << share;
    EXPECT_TRUE(says(answer.error().message, why));
  };
  const std::array<double, 3> place = {1, 2, 3};
  EXPECT_EQ(read(-1, place.data()).value().positions(0, 2), 3);
  expect_broken(0.5, "no share from which they could be computed");
  contract.limit_gives = LimitGives::start_plus;
  EXPECT_TRUE(read(0.5));
  expect_broken(-1, "it gives no positions");
  expect_broken(1.5, "is not from 0 to 1");
  expect_broken(std::numeric_limits<double>::quiet_NaN(), "is not from 0 to 1");
  claims.set(Claim::path_free);
  EXPECT_FALSE(read(-1, place.data())) << "the claim speaks of a share";
  const std::array<double, 3> none = {1, std::numeric_limits<double>::infinity(), 3};
  EXPECT_FALSE(read(0.5, none.data()));
}

TEST(LimitClaims, GoWithTheFunctionAndTheNumber) {
  struct Row {
    Claim claim;
    double progress;
    bool has_function, is_right;
  };
  for (const auto& [claim, progress, has_function, is_right] :
       {Row{Claim::total, 0, false, true},
        {Claim::total, 0, true, false},
        {Claim::commit_free, 0, false, false},
        {Claim::commit_free, 0, true, true},
        {Claim::progress, 0, true, false},
        {Claim::progress, 0.5, true, true},
        {Claim::commit_free, 0.5, true, false}})
    EXPECT_EQ(fault_of_limits({claim}, {.progress = progress}, has_function).empty(), is_right)
        << name_of(claim) << progress << has_function;
  EXPECT_NE(fault_of({.progress = 1.5}), "");
}

}  // namespace
}  // namespace assay::properties
