// A law that cannot fail proves nothing, so each law is checked on wrong results, or on a wrong
// pair set, and must report them.
#include <fmt/format.h>

#include "detector/contact/elementary.h"
#include "detector/mesh/step_types.h"
#include "detector/step/stages.h"
#include "properties/faults/fault.h"
#include "properties/generators/draft.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/laws/law.h"
#include "tests/properties/laws/judged_case.h"

namespace assay::properties::test {
namespace {

using detector::Answer, detector::StepResult, detector::ViewSign;

using Tamper = std::function<void(JudgedCase&)>;

Tamper each_result(std::function<void(StepResult&)> change) {
  return [change](JudgedCase& c) {
    for (auto& result : c.results) change(result);
  };
}

const Tamper turn_signs = each_result([](StepResult& r) {
  for (auto& sign : r.signs) sign = static_cast<ViewSign>(-static_cast<int>(sign));
});
const Tamper all_positive = each_result(
    [](StepResult& r) { std::fill(r.signs.begin(), r.signs.end(), ViewSign::positive); });
const Tamper no_doubts = each_result(
    [](StepResult& r) { std::fill(r.doubts.begin(), r.doubts.end(), std::uint8_t{0}); });
const Tamper all_dirty = each_result(
    [](StepResult& r) { std::fill(r.doubts.begin(), r.doubts.end(), detector::doubt::dirty); });
const Tamper all_violated = each_result(
    [](StepResult& r) { std::fill(r.doubts.begin(), r.doubts.end(), detector::doubt::violated); });
const Tamper no_pairs = each_result([](StepResult& r) { r.pairs.clear(); });
const Tamper wrong_size = each_result([](StepResult& r) { ++r.view_positive; });
const Tamper free_component = each_result([](StepResult& r) { ++r.counts.free_components; });
const Tamper always_free = each_result([](StepResult& r) {
  r.answer = Answer::free;
  r.pairs.clear();
});
const Tamper undecided = each_result([](StepResult& r) { r.answer = Answer::undecided; });
const Tamper late = each_result([](StepResult& r) {
  if (r.answer == Answer::collision) r.first = {1, 1};
  for (auto& contact : r.pairs) contact.time = {1, 1};
});
const Tamper invented = each_result([](StepResult& r) {
  r.answer = Answer::collision;
  r.first = {0, 0};
  if (r.doubts.size() > 1) r.pairs = {{{0, 1}, {0, 0}, {}}};
});

// The oracle finds one contact, of two triangles of one component and one strict sign.
void meet_among_one_sign(JudgedCase& c) {
  for (std::size_t s = 0; s < c.results.size(); ++s) {
    auto& judgement = c.judgements[s];
    const auto& signs = c.results[s].signs;
    for (std::int32_t b = 1; b < static_cast<std::int32_t>(c.source.triangles.rows()); ++b) {
      const auto i = static_cast<std::size_t>(b);
      if (signs.size() <= i || signs[i] == ViewSign::zero || signs[i] != signs[i - 1]) continue;
      judgement.answer = Answer::collision;
      judgement.first = {0.5, 0.5};
      judgement.pairs = {{{b - 1, b}, judgement.first, {}}};
      break;
    }
  }
}

// Wrong on the side of positive x alone, so that it matters where the mesh is.
class BlindBeyondOrigin : public detector::ElementaryTest {
  detector::ContactResult test(const detector::FourPoints& query,
                               detector::Want want) const override {
    if (query.points[0].t0[0] > 0) return {};
    return ElementaryTest::test(query, want);
  }
};

// Sees nothing in the last part of a step.
class BlindInTheEnd : public detector::ElementaryTest {
  detector::ContactResult test(const detector::FourPoints& query,
                               detector::Want want) const override {
    const auto result = ElementaryTest::test(query, detector::Want::first_time);
    if (result.contact && result.time.lo > 0.75) return {};
    return want == detector::Want::first_time ? result : ElementaryTest::test(query, want);
  }
};

template <class Elementary>
detector::Stages with_fault(const detector::Options& options) {
  auto stages = detector::standard_stages(options);
  stages.elementary = std::make_shared<Elementary>();
  return stages;
}

// The standard stages, but for the traditional scheme, in which this fault is planted.
StagesOf with_cone_fault(std::string_view name) {
  return [fault = find_fault(name)](const detector::Options& options) {
    const bool is_traditional = options.culling == detector::Culling::normal_cone;
    return is_traditional ? fault->stages(options) : detector::standard_stages(options);
  };
}

struct Wrong {
  Tamper tamper = [](JudgedCase&) {};
  StagesOf stages_of = detector::standard_stages;
};

const std::map<std::string, Wrong, std::less<>>& wrongs() {
  static const auto all = [] {
    std::map<std::string, Wrong, std::less<>> made = {
        {"L11_ApexesGoOnFromWhereTheyWere", {each_result([](StepResult& r) {
           for (auto& apex : r.apexes) apex.t1[0] += 1;
         })}},
        {"L13_CertifiedPatchesAreFree", {.stages_of = with_cone_fault("cone/no-contour-test")}},
        {"L13_EveryContactIsACandidate", {.stages_of = with_cone_fault("cone/normals-at-end")}},
        {"Change_Translation", {.stages_of = with_fault<BlindBeyondOrigin>}},
    };
    for (const auto& name :
         tests::words("Change_StepHalved Change_StepReversed Claim_InEveryPairOfOptions "
                      "L16_WithinADistanceIsWhatTheOracleFinds L17_LimitsAreFreeAndGoFar"))
      made[name] = {.stages_of = with_fault<BlindInTheEnd>};
    // The laws that each of these breaks.
    const std::vector<std::pair<Tamper, const char*>> by_tamper = {
        {turn_signs,
         "L1_SignsHoldAtEveryPoint L2_SignsAreTheOracles_Point "
         "L2_SignsAreTheOracles_Line L2_GhostSignsAreTheOracles_Point "
         "L2_GhostSignsAreTheOracles_Line Change_PowerOfTwo"},
        {wrong_size,
         "Sets_AreDisjointAndCover L12_BadInputIsNamedAndChangesNothing "
         "Change_EqualEndsAreAPoint Change_EvaluateChangesNothing "
         "Change_ThreadsDoNotShow Change_StopsChangeNothing"},
        {meet_among_one_sign,
         "L3_FirstContactIsACandidate L6_OutsideKSomethingMetBefore "
         "L4_AllPositiveIsCollisionFree_Point L4_AllPositiveIsCollisionFree_Line "
         "L4_AllPositiveIsCollisionFree_MovingLine L4_AllNegativeIsCollisionFree "
         "L5_AllPositiveAndWindingOneIsFree_Unclosed"},
        {all_dirty,
         "L5_AllPositiveAndWindingOneIsFree_Closed L9_DirtyIsTheOraclesAccount "
         "L9_AllPositiveAtTheStartReleases L10_ComponentsAreCleanByThemselves "
         "L15_StepsWithoutViewsAreInTheAccount"},
        {free_component, "L5_TheFreePathIsTaken"},
        {late,
         "L7_ClosureIsThePairSet Claim_NotLate Claim_FirstTime Change_VertexNumbers "
         "Change_StepsBeforeDoNotShow"},
        {always_free,
         "Claim_FreeSound L12_NeverFreeOnAGuess_BrokenEdges "
         "L12_NeverFreeOnAGuess_Collapsed L12_NeverFreeOnAGuess_SeveralLayers "
         "Change_AxesExchanged"},
        {no_pairs,
         "Claim_FirstPairs Claim_AllPairs L10_PairsOfTwoComponentsNeedNoSigns "
         "L10_EachComponentAsIfAlone L14_NoContactIsAmongWhatIsProved "
         "Change_TriangleOrder L18_RefinedMeshHasTheSameContacts"},
        {invented, "Claim_NoSpurious Change_RepeatedCall"},
        {undecided, "Claim_Total"},
        {no_doubts,
         "L8_CarriedCleanIsClean L8_WhatIsNotCleanStaysDirty "
         "L8_CleanAndUntouchedStaysClean L9_NewStartIsTheOraclesLayers "
         "L11_VvHoldsWhatWasTouchedUntilClean Change_Mirror Change_RestoredStateGoesOn"},
        {all_violated, "L11_ViolatedIsWhatGhostsTouch L11_OrderOfHolesDoesNotMatter"},
        {all_positive, "L12_ZeroAreaStaysInV0 Change_InsideOutSwapsSigns"},
    };
    for (const auto& [tamper, names] : by_tamper)
      for (const auto& name : tests::words(names)) made[name] = {tamper};
    return made;
  }();
  return all;
}

// Pure statements about a formula: no result can refute them. See the test of exact values below.
const std::set<std::string_view> about_formulas = {"L1_ClampFormIsRegionForm",
                                                   "L1_InnerValuesLieBetweenCornerValues"};

TEST(LawsCanFail, EachNoticesWhatIsWrong) {
  constexpr int most_cases = 600;
  for (const auto& law : laws()) {
    if (about_formulas.contains(law.name)) continue;
    const auto wrong = wrongs().find(law.name);
    ASSERT_NE(wrong, wrongs().end()) << law.name;
    LawTally tally;
    int cases = 0;
    for (; cases < most_cases && tally.broken_steps == 0; ++cases) {
      const auto& family = families()[static_cast<std::size_t>(cases) % families().size()];
      const auto id = fmt::format("{}:20116:{}:{}", law.name, family.name, cases);
      auto c = make_case(family, id).c;
      constexpr Eigen::Index most_triangles = 40;
      if (c.triangles.rows() > most_triangles) continue;
      Setting setting = setting_for(law, id);
      setting.stages_of = wrong->second.stages_of;
      JudgedCase judged(std::move(c), std::move(setting));
      wrong->second.tamper(judged);
      CaseFacts facts = judged.facts();
      law.check(facts, tally);
    }
    EXPECT_GT(tally.broken_steps, 0u) << law.name;
    std::printf("%-46s after %3d cases: %s\n", std::string(law.name).c_str(), cases,
                tally.first_broken.c_str());
  }
}

detector::MovingPoint still(double x, double y, double z) { return {{x, y, z}, {x, y, z}}; }

// Three corners, three signs: a corner's own nearest point decides, not that of another one.
TEST(ExactView, L1_CornersOfATriangleMayHaveAllSigns) {
  const ExactView view({still(0.5, 1, 0.125), still(-0.5, 1, 0.875), still(0, 5, 0.5)},
                       {still(0, 0, 0), still(0, 0, 1)}, 0);
  EXPECT_LT(view.by_clamp(view.corner(0)), 0);
  EXPECT_GT(view.by_clamp(view.corner(1)), 0);
  EXPECT_EQ(view.by_clamp(view.corner(2)), 0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(view.region_of(view.corner(i)), Region::r2);
    EXPECT_EQ(view.by_clamp(view.corner(i)), view.by_region(view.corner(i)));
  }
  const ExactView beyond({still(1, 0, 2), still(0, 1, 3), still(-1, -1, -2)},
                         {still(0, 0, 0), still(0, 0, 1)}, 0);
  EXPECT_EQ(beyond.region_of(beyond.corner(0)), Region::r1);
  EXPECT_EQ(beyond.region_of(beyond.corner(2)), Region::r0);
}

TEST(ExactView, TimesAreEighthsAndWeightsSixteenths) {
  detector::MovingPoint rising = still(0, 0, 1);
  rising.t1[2] = 3;
  const detector::ViewPrimitive origin{still(0, 0, 0), still(0, 0, 0)};
  const ExactView half({rising, still(1, 0, 2), still(0, 1, 2)}, origin, 4);
  EXPECT_EQ(half.by_region(half.corner(0)), half.by_region(half.corner(1)));
  EXPECT_EQ(half.by_region(half.inner_point({5, 5, 6})), half.by_region(half.corner(2)));
  EXPECT_FALSE(half.has_zero_area());
  EXPECT_TRUE(ExactView({rising, still(1, 0, 1), still(2, 0, 1)}, origin, 0).has_zero_area());
}

}  // namespace
}  // namespace assay::properties::test
