// Every law by rapidcheck, under its own name; and all laws over cases of all families.
//
// rapidcheck draws a 64-bit number, and nothing else. The number and the name of the law make the
// id of a case, and the id makes the case. Shrinking is off, because it would only make the number
// smaller; the reducer makes minimal meshes. If the law does not apply to a case, the case is
// discarded.
//
// RC_PARAMS="seed=... max_success=..." runs other or more cases, ASSAY_CASE=ID runs one case alone.
#include <fmt/format.h>
#include <rapidcheck.h>

#include "properties/generators/draft.h"
#include "properties/judging/case_options.h"
#include "properties/judging/exam.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/laws/law.h"
#include "tests/curated_cases.h"
#include "tests/properties/laws/judged_case.h"

namespace assay::properties::test {
namespace {

// Most cases are small: a law is put to large meshes by the campaign.
constexpr Eigen::Index most_triangles = 40;

const bool parameters_are_set = [] {
  return setenv("RC_PARAMS", "seed=20114 max_success=20 max_discard_ratio=100", 0) == 0;
}();

std::string drawn_id(const Law& law, std::uint64_t number) {
  const auto stratum = families()[number % families().size()].name;
  return fmt::format("{}:{}:{}:0", law.name, number, stratum);
}

LawTally tally_of(const Law& law, const std::string& id) {
  LawTally tally;
  corpus::Case c = case_of(id).c;
  if (c.triangles.rows() > most_triangles) return tally;
  const JudgedCase judged(std::move(c), setting_for(law, id));
  CaseFacts facts = judged.facts();
  law.check(facts, tally);
  if (tally.broken_steps != 0)
    fmt::print("{}\nreplay: ASSAY_CASE={} ctest --preset law -R Laws.{}\n", tally.first_broken, id,
               law.name);
  return tally;
}

void run_law(std::string_view name) {
  const Law* law = law_named(name);
  ASSERT_NE(law, nullptr);
  if (const char* only = std::getenv("ASSAY_CASE")) {
    const LawTally tally = tally_of(*law, only);
    EXPECT_GT(tally.premise, 0u) << "the law does not apply to this case";
    EXPECT_EQ(tally.broken_steps, 0u) << tally.first_broken;
    return;
  }
  LawTally sum;
  std::uint64_t cases = 0;
  const bool holds = rc::check(std::string(law->statement), [&] {
    // Of the full size from the first draw on: all bits of the number are random.
    const auto number =
        *rc::gen::noShrink(rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>()));
    const LawTally tally = tally_of(*law, drawn_id(*law, number));
    ++cases;
    sum += tally;
    RC_PRE(tally.premise > 0u);
    RC_ASSERT(tally.broken_steps == 0u);
  });
  fmt::print("{} cases, premise {} times, close {} times\n", cases, sum.premise, sum.close);
  EXPECT_TRUE(holds) << sum.first_broken;
  EXPECT_GT(sum.premise, 0u);
}

// The tests of the laws, each by its name: a law that goes is missed, and a new one belongs here.
const auto law_tests = tests::words(
    "L1_ClampFormIsRegionForm L1_InnerValuesLieBetweenCornerValues L1_SignsHoldAtEveryPoint "
    "L2_SignsAreTheOracles_Point L2_SignsAreTheOracles_Line L2_GhostSignsAreTheOracles_Point "
    "L2_GhostSignsAreTheOracles_Line Sets_AreDisjointAndCover L3_FirstContactIsACandidate "
    "L6_OutsideKSomethingMetBefore L4_AllPositiveIsCollisionFree_Point "
    "L4_AllPositiveIsCollisionFree_Line L4_AllPositiveIsCollisionFree_MovingLine "
    "L4_AllNegativeIsCollisionFree L5_AllPositiveAndWindingOneIsFree_Closed "
    "L5_AllPositiveAndWindingOneIsFree_Unclosed L5_TheFreePathIsTaken L7_ClosureIsThePairSet "
    "Claim_FreeSound Claim_NotLate Claim_FirstTime Claim_FirstPairs Claim_AllPairs "
    "Claim_NoSpurious Claim_Total L8_CarriedCleanIsClean L8_WhatIsNotCleanStaysDirty "
    "L8_CleanAndUntouchedStaysClean L9_DirtyIsTheOraclesAccount "
    "L9_NewStartIsTheOraclesLayers L9_AllPositiveAtTheStartReleases "
    "L10_PairsOfTwoComponentsNeedNoSigns L10_ComponentsAreCleanByThemselves "
    "L10_EachComponentAsIfAlone L11_ViolatedIsWhatGhostsTouch "
    "L11_VvHoldsWhatWasTouchedUntilClean L11_ApexesGoOnFromWhereTheyWere "
    "L11_OrderOfHolesDoesNotMatter L12_NeverFreeOnAGuess_BrokenEdges "
    "L12_NeverFreeOnAGuess_Collapsed L12_NeverFreeOnAGuess_SeveralLayers "
    "L12_ZeroAreaStaysInV0 L12_BadInputIsNamedAndChangesNothing L13_CertifiedPatchesAreFree "
    "L13_EveryContactIsACandidate L14_NoContactIsAmongWhatIsProved "
    "L15_StepsWithoutViewsAreInTheAccount Change_VertexNumbers Change_TriangleOrder "
    "Change_PowerOfTwo Change_Translation Change_Mirror Change_AxesExchanged "
    "Change_InsideOutSwapsSigns Change_StepHalved Change_EqualEndsAreAPoint "
    "Change_RepeatedCall Change_EvaluateChangesNothing Change_ThreadsDoNotShow "
    "Change_RestoredStateGoesOn Change_StepReversed Change_StepsBeforeDoNotShow "
    "L16_WithinADistanceIsWhatTheOracleFinds L17_LimitsAreFreeAndGoFar "
    "Change_StopsChangeNothing L18_RefinedMeshHasTheSameContacts Claim_InEveryPairOfOptions");

class LawTest : public testing::Test {
 public:
  explicit LawTest(const std::string& name) : name_(name) {}
  void TestBody() override { run_law(name_); }

 private:
  const std::string name_;
};

const bool laws_have_tests = [] {
  for (const auto& name : law_tests)
    testing::RegisterTest("Laws", name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [=]() -> testing::Test* { return new LawTest(name); });
  return true;
}();

TEST(LawNames, EachLawHasATestOfItsName) {
  std::set<std::string> names;
  for (const auto& law : laws()) names.emplace(law.name);
  EXPECT_EQ(names, std::set<std::string>(law_tests.begin(), law_tests.end()));
}

TEST(LawNames, EachNumberHasALawAndEachLawItsNumber) {
  std::set<std::string> numbers, names;
  for (const auto& law : laws()) {
    numbers.insert(std::string(law.number));
    EXPECT_TRUE(names.insert(std::string(law.name)).second) << law.name << " twice";
    EXPECT_FALSE(law.statement.empty() || law.needs.empty()) << law.name;
    EXPECT_TRUE(law.number.front() != 'L' || law.name.starts_with(fmt::format("{}_", law.number)))
        << law.name;
  }
  for (int i = 1; i <= 15; ++i) EXPECT_TRUE(numbers.count(fmt::format("L{}", i))) << "L" << i;
}

// All sizes and families; dear laws have their share of the cases. Printed is how often the premise
// of each law held, how often its values came close, and how often the law was broken.
TEST(LawTable, L1_to_L13_AllLawsHoldOverAllFamilies) {
  constexpr int cases_of_family = 40;
  std::vector<LawTally> tallies(laws().size());
  for (const auto& family : families()) {
    for (int i = 0; i < cases_of_family; ++i) {
      const auto id = fmt::format("laws:20115:{}:{}", family.name, i);
      const JudgedCase judged(make_case(family, id).c, setting_of(id));
      CaseFacts facts = judged.facts();
      for (std::size_t l = 0; l < tallies.size(); ++l)
        if (is_checked_on(laws()[l], id)) laws()[l].check(facts, tallies[l]);
    }
  }
  fmt::print("{:<46} {:>9} {:>9} {:>7}\n", "law", "premise", "close", "broken");
  for (std::size_t l = 0; l < tallies.size(); ++l) {
    const auto& [premise, close, broken, first_broken] = tallies[l];
    fmt::print("{:<46} {:>9} {:>9} {:>7}\n", laws()[l].name, premise, close, broken);
    EXPECT_EQ(broken, 0u) << laws()[l].name << ": " << first_broken;
    EXPECT_GT(premise, 0u) << laws()[l].name << " was never met";
  }
}

// Hand-made meshes, each with its own primitive, ends of sequences, and trust where none is due.
TEST(LawTable, L1_to_L13_AllLawsHoldOfCuratedCases) {
  const auto cases = tests::curated_cases();
  std::uint64_t met = 0;
  for (const auto& c : cases) {
    if (c.expected.answer == detector::Answer::error) continue;
    for (const auto culling : {detector::Culling::view_point, detector::Culling::view_line}) {
      Setting setting;
      setting.options = options_of(c);
      setting.options.culling = culling;
      const JudgedCase judged(c, setting);
      CaseFacts facts = judged.facts();
      for (const auto& law : laws()) {
        LawTally tally;
        law.check(facts, tally);
        EXPECT_EQ(tally.broken_steps, 0u) << law.name << ": " << tally.first_broken;
        met += tally.premise;
      }
    }
  }
  fmt::print("{} cases, premises met {} times\n", cases.size(), met);
  EXPECT_GT(met, cases.size());
}

TEST(LawTable, TalliesAddUpInAnyOrder) {
  const LawTally a{3, 1, 1, "case 7"}, b{5, 2, 0, ""}, c{1, 1, 1, "case 4"};
  LawTally forward = a, backward = c;
  (forward += b) += c;
  (backward += b) += a;
  EXPECT_EQ(forward, backward);
  EXPECT_EQ(forward, (LawTally{9, 4, 2, "case 4"}));
}

}  // namespace
}  // namespace assay::properties::test
