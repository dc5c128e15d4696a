// The laws about state that is carried from step to step, checked on the curated cases: with views
// from a point, and under Culling::view_auto, whose steps may or may not have views. If a case
// states which steps have views, this is checked, too.
#include <nlohmann/json.hpp>

#include "properties/laws/law.h"
#include "tests/curated_cases.h"
#include "tests/properties/laws/judged_case.h"

namespace assay::properties::test {
namespace {

const auto carried_laws = tests::words(
    "L8_CarriedCleanIsClean L8_WhatIsNotCleanStaysDirty L8_CleanAndUntouchedStaysClean "
    "L9_DirtyIsTheOraclesAccount L9_NewStartIsTheOraclesLayers "
    "L15_StepsWithoutViewsAreInTheAccount L11_ViolatedIsWhatGhostsTouch "
    "L11_ApexesGoOnFromWhereTheyWere Change_RepeatedCall Change_RestoredStateGoesOn");

// The case behind a step in which nothing moves. Of a first step view-auto knows less than of later
// ones, so this lets every step of the case go on from a committed one.
corpus::Case after_a_still_step(corpus::Case c) {
  std::vector<corpus::CaseStep> script = {{0, 1, true}};
  for (auto step : corpus::steps_of(c)) {
    ++step.from;
    ++step.to;
    script.push_back(step);
  }
  c.script = std::move(script);
  c.frames.insert(c.frames.begin(), c.frames.front());
  if (c.view)
    for (auto* end : {&c.view->q0, &c.view->q1})
      if (!end->empty()) end->insert(end->begin(), end->front());
  return c;
}

class CuratedLaws : public testing::TestWithParam<std::tuple<detector::Culling, detector::Pairs>> {
};

TEST_P(CuratedLaws, OfWhatIsCarriedHold) {
  LawTally sum;
  for (const auto& c : tests::curated_cases()) {
    if (c.expected.answer == detector::Answer::error) continue;
    Setting setting;
    std::tie(setting.options.culling, setting.options.pairs) = GetParam();
    const bool is_auto = setting.options.culling == detector::Culling::view_auto;
    const JudgedCase judged(is_auto ? after_a_still_step(c) : c, setting);
    CaseFacts facts = judged.facts();
    for (const auto& name : carried_laws) {
      LawTally tally;
      law_named(name)->check(facts, tally);
      EXPECT_EQ(tally.broken_steps, 0u) << name << ": " << tally.first_broken;
      sum += tally;
    }
  }
  EXPECT_GT(sum.premise, 500u);
}

INSTANTIATE_TEST_SUITE_P(
    AutoAndPointByAllAndFirst, CuratedLaws,
    testing::Combine(testing::Values(detector::Culling::view_auto, detector::Culling::view_point),
                     testing::Values(detector::Pairs::all, detector::Pairs::first)));

// The id draws the configuration, so a case under many ids meets many of them.
TEST(CuratedOptions, HoldInManyConfigurations) {
  constexpr int configurations = 24;
  const Law* law = law_named("Claim_InEveryPairOfOptions");
  std::uint64_t met = 0;
  for (const auto& c : tests::curated_cases()) {
    if (c.expected.answer == detector::Answer::error) continue;
    Setting setting;
    setting.options.culling = detector::Culling::view_line;
    JudgedCase judged(c, setting);
    for (int n = 0; n < configurations; ++n) {
      judged.source.id = c.id + "/" + std::to_string(n);
      CaseFacts facts = judged.facts();
      LawTally tally;
      law->check(facts, tally);
      EXPECT_EQ(tally.broken_steps, 0u) << tally.first_broken;
      met += tally.premise;
    }
  }
  std::printf("%llu steps\n", static_cast<unsigned long long>(met));
  EXPECT_GT(met, 3000u);
}

// "views_used" of a case: 1 for each step in which view-auto used its views, 0 for the others.
TEST(CuratedViews, AreUsedInTheStepsThatAreStated) {
  int stated = 0;
  for (const auto& c : tests::curated_cases()) {
    const auto pending = nlohmann::json::parse(c.pending);
    if (!pending.contains("views_used")) continue;
    ++stated;
    auto player = CasePlayer::make(c, {detector::Culling::view_auto});
    ASSERT_TRUE(player) << c.id;
    std::vector<int> used;
    for (std::size_t s = 0; s < player.value().steps(); ++s)
      used.push_back(player.value().play(s).signs.empty() ? 0 : 1);
    EXPECT_EQ(used, pending["views_used"].get<std::vector<int>>()) << c.id;
  }
  EXPECT_GE(stated, 4);
}

}  // namespace
}  // namespace assay::properties::test
