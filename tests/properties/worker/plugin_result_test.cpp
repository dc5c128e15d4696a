// A plug-in's result: what it says, and what it says against the rules.
#include "properties/worker/plugin/plugin_reading.h"
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

// Who judges a plug-in may ask whether it gave up by itself or broke the rules.
TEST(PluginResult, WhatThePlugInSaysItselfIsNoBrokenRule) {
  assay_result raw = {};
  raw.answer = ASSAY_ERROR;
  const auto silent = step_result(raw, triangle_count);
  ASSERT_FALSE(silent);
  EXPECT_EQ(silent.error().message, "an error without a message");
  raw.message = "too thin";
  EXPECT_EQ(step_result(raw, triangle_count).error().message, "too thin");
}

TEST(PluginResult, BrokenRulesAreNamed) {
  const auto expect_broken = [](const assay_result& raw, const std::string& why) {
    const auto result = step_result(raw, triangle_count);
    ASSERT_FALSE(result) << why;
    EXPECT_EQ(result.error().message, why);
  };
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
  expect_broken(raw, "answer 99 is none");
}

}  // namespace
}  // namespace assay::properties
