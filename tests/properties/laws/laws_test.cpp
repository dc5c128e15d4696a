// Every law by rapidcheck, under its own name; and all of them over cases of all families.
//
// rapidcheck draws a 64-bit number, and nothing else: the number and the law's name make a case's
// id, and the id makes the case. Shrinking is off, as it would only make the number smaller
// (minimal meshes are the reducer's). A case that the law does not apply to is discarded.
//
// RC_PARAMS="seed=... max_success=..." runs other cases or more of them, ASSAY_CASE=ID one alone.
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
  if (tally.broken_steps != 0) {
    fmt::print("{}\nreplay: ASSAY_CASE={} ctest --preset law -R Laws.{}\n", tally.first_broken, id,
               law.name);
  }
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

#define LAW_TEST(name) \
  TEST(Laws, name) { run_law(#name); }

// Counts over many cases how often the premise of each law held, how often its values came
// close, and how often the law was broken.
class LawTable {
 public:
  // Checks the laws on the case: all that cost little, and each costly one if the case's id is in
  // that law's share.
  void add(CaseFacts& facts) {
    for (std::size_t i = 0; i < tallies_.size(); ++i) {
      const Law& law = laws()[i];
      if (is_checked_on(law, facts.source().id)) law.check(facts, tallies_[i]);
    }
  }

  // In the order of laws().
  const std::vector<LawTally>& tallies() const { return tallies_; }

  // One line for each law: name, premise, share of close ones, broken; below it what first broke
  // it.
  std::string text() const {
    std::string out =
        fmt::format("{:<46} {:>9} {:>7} {:>7}\n", "law", "premise", "close", "broken");
    for (std::size_t i = 0; i < tallies_.size(); ++i) {
      const auto& tally = tallies_[i];
      const double share = tally.premise == 0 ? 0
                                              : 100 * static_cast<double>(tally.close) /
                                                    static_cast<double>(tally.premise);
      out += fmt::format("{:<46} {:>9} {:>5.1f} % {:>7}\n", laws()[i].name, tally.premise, share,
                         tally.broken_steps);
      if (tally.broken_steps != 0) out += fmt::format("    {}\n", tally.first_broken);
    }
    return out;
  }

 private:
  std::vector<LawTally> tallies_ = std::vector<LawTally>(laws().size());
};

// clang-format off
LAW_TEST(L1_ClampFormIsRegionForm)
LAW_TEST(L1_InnerValuesLieBetweenCornerValues)
LAW_TEST(L1_SignsHoldAtEveryPoint)
LAW_TEST(L2_SignsAreTheOracles_Point)
LAW_TEST(L2_SignsAreTheOracles_Line)
LAW_TEST(L2_GhostSignsAreTheOracles_Point)
LAW_TEST(L2_GhostSignsAreTheOracles_Line)
LAW_TEST(Sets_AreDisjointAndCover)
LAW_TEST(L3_FirstContactIsACandidate)
LAW_TEST(L6_OutsideKSomethingMetBefore)
LAW_TEST(L4_AllPositiveIsCollisionFree_Point)
LAW_TEST(L4_AllPositiveIsCollisionFree_Line)
LAW_TEST(L4_AllPositiveIsCollisionFree_MovingLine)
LAW_TEST(L4_AllNegativeIsCollisionFree)
LAW_TEST(L5_AllPositiveAndWindingOneIsFree_Closed)
LAW_TEST(L5_AllPositiveAndWindingOneIsFree_Unclosed)
LAW_TEST(L5_TheFreePathIsTaken)
LAW_TEST(L7_ClosureIsThePairSet)
LAW_TEST(Claim_FreeSound)
LAW_TEST(Claim_NotLate)
LAW_TEST(Claim_FirstTime)
LAW_TEST(Claim_FirstPairs)
LAW_TEST(Claim_AllPairs)
LAW_TEST(Claim_NoSpurious)
LAW_TEST(Claim_Total)
LAW_TEST(L8_CarriedCleanIsClean)
LAW_TEST(L8_WhatIsNotCleanStaysDirty)
LAW_TEST(L8_CleanAndUntouchedStaysClean)
LAW_TEST(L9_DirtyIsTheOraclesAccount)
LAW_TEST(L9_NewStartIsTheOraclesLayers)
LAW_TEST(L9_AllPositiveAtTheStartReleases)
LAW_TEST(L10_PairsOfTwoComponentsNeedNoSigns)
LAW_TEST(L10_ComponentsAreCleanByThemselves)
LAW_TEST(L10_EachComponentAsIfAlone)
LAW_TEST(L11_ViolatedIsWhatGhostsTouch)
LAW_TEST(L11_VvHoldsWhatWasTouchedUntilClean)
LAW_TEST(L11_ApexesGoOnFromWhereTheyWere)
LAW_TEST(L11_OrderOfHolesDoesNotMatter)
LAW_TEST(L12_NeverFreeOnAGuess_BrokenEdges)
LAW_TEST(L12_NeverFreeOnAGuess_Collapsed)
LAW_TEST(L12_NeverFreeOnAGuess_SeveralLayers)
LAW_TEST(L12_ZeroAreaStaysInV0)
LAW_TEST(L12_BadInputIsNamedAndChangesNothing)
LAW_TEST(L13_CertifiedPatchesAreFree)
LAW_TEST(L13_EveryContactIsACandidate)
LAW_TEST(L14_NoContactIsAmongWhatIsProved)
LAW_TEST(L15_StepsWithoutViewsAreInTheAccount)
LAW_TEST(Change_VertexNumbers)
LAW_TEST(Change_TriangleOrder)
LAW_TEST(Change_PowerOfTwo)
LAW_TEST(Change_Translation)
LAW_TEST(Change_Mirror)
LAW_TEST(Change_AxesExchanged)
LAW_TEST(Change_InsideOutSwapsSigns)
LAW_TEST(Change_StepHalved)
LAW_TEST(Change_EqualEndsAreAPoint)
LAW_TEST(Change_RepeatedCall)
LAW_TEST(Change_EvaluateChangesNothing)
LAW_TEST(Change_ResetStartsAnew)
LAW_TEST(Change_RowStride)
LAW_TEST(Change_ThreadsDoNotShow)
LAW_TEST(Change_RestoredStateGoesOn)
LAW_TEST(Change_StepReversed)
LAW_TEST(Change_StepsBeforeDoNotShow)
LAW_TEST(L16_WithinADistanceIsWhatTheOracleFinds)
LAW_TEST(L17_LimitsAreFreeAndGoFar)
LAW_TEST(Change_StopsChangeNothing)
LAW_TEST(L18_RefinedMeshHasTheSameContacts)
LAW_TEST(Claim_InEveryPairOfOptions)
// clang-format on

TEST(Laws, EachHasATestOfItsName) {
  std::set<std::string> tests;
  const auto& program = *testing::UnitTest::GetInstance();
  for (int s = 0; s < program.total_test_suite_count(); ++s) {
    const auto& suite = *program.GetTestSuite(s);
    if (std::string(suite.name()) != "Laws") continue;
    for (int i = 0; i < suite.total_test_count(); ++i) tests.insert(suite.GetTestInfo(i)->name());
  }
  for (const auto& law : laws()) EXPECT_TRUE(tests.count(std::string(law.name))) << law.name;
}

TEST(Laws, EachNumberHasALawAndEachLawItsNumber) {
  std::set<std::string> numbers, names;
  for (const auto& law : laws()) {
    numbers.insert(std::string(law.number));
    EXPECT_TRUE(names.insert(std::string(law.name)).second) << law.name << " twice";
    EXPECT_FALSE(law.statement.empty() || law.needs.empty()) << law.name;
    if (law.number.front() == 'L') {
      EXPECT_TRUE(law.name.starts_with(fmt::format("{}_", law.number))) << law.name;
    }
  }
  for (int i = 1; i <= 15; ++i) EXPECT_TRUE(numbers.count(fmt::format("L{}", i))) << "L" << i;
}

// All sizes and families; dear laws have their share of the cases.
TEST(LawTable, L1_to_L13_AllLawsHoldOverAllFamilies) {
  constexpr int cases_of_family = 40;
  LawTable table;
  for (const auto& family : families()) {
    for (int i = 0; i < cases_of_family; ++i) {
      const auto id = fmt::format("laws:20115:{}:{}", family.name, i);
      const JudgedCase judged(make_case(family, id).c, setting_of(id));
      CaseFacts facts = judged.facts();
      table.add(facts);
    }
  }
  fmt::print("{} cases\n{}", cases_of_family * families().size(), table.text());
  for (std::size_t i = 0; i < laws().size(); ++i) {
    EXPECT_EQ(table.tallies()[i].broken_steps, 0u);
    EXPECT_GT(table.tallies()[i].premise, 0u) << laws()[i].name << " was never met";
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

LawTally tally(std::uint64_t premise, std::uint64_t close, std::uint64_t broken,
               std::string first_broken) {
  return {premise, close, broken, std::move(first_broken)};
}

TEST(LawTable, TalliesAddUpInAnyOrder) {
  const LawTally a = tally(3, 1, 1, "case 7"), b = tally(5, 2, 0, ""), c = tally(1, 1, 1, "case 4");
  LawTally forward = a, backward = c;
  (forward += b) += c;
  (backward += b) += a;
  EXPECT_EQ(forward, backward);
  EXPECT_EQ(forward, tally(9, 4, 2, "case 4"));
}

}  // namespace
}  // namespace assay::properties::test
