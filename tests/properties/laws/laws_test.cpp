// Every law by rapidcheck, under its own name; and all of them over cases of all families.
#include <fmt/format.h>

#include "properties/generators/draft.h"
#include "properties/judging/case_check.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/laws/law.h"
#include "tests/curated_cases.h"
#include "tests/properties/laws/law_property.h"

namespace assay::properties::test {
namespace {

// Counts over many cases how often the premise of each law held, how often its values came
// close, and how often the law was broken.
//
// The order in which cases are added and tables are merged does not matter, so threads may have
// one each.
class LawTable {
 public:
  LawTable();

  // Checks the laws on the case: all that cost little, and each costly one if the case's id is in
  // that law's share.
  void add(CaseFacts& facts);
  void merge(const LawTable& other);

  // In the order of laws().
  const std::vector<LawTally>& tallies() const { return tallies_; }
  std::uint64_t broken() const;
  // The laws that were hardly tried: their premise held less often than `premises` times, or the
  // share of these times in which they came close is below `least_close`.
  std::vector<const Law*> starved(std::uint64_t premises, double least_close) const;

  // One line for each law: name, premise, share of close ones, broken; below it what first broke
  // it.
  std::string text() const;

 private:
  std::vector<LawTally> tallies_;
};

LawTable::LawTable() : tallies_(laws().size()) {}

void LawTable::add(CaseFacts& facts) {
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    const Law& law = laws()[i];
    if (is_checked_on(law, facts.source().id)) law.check(facts, tallies_[i]);
  }
}

void LawTable::merge(const LawTable& other) {
  for (std::size_t i = 0; i < tallies_.size(); ++i) tallies_[i] += other.tallies_[i];
}

std::uint64_t LawTable::broken() const {
  std::uint64_t sum = 0;
  for (const auto& tally : tallies_) sum += tally.broken;
  return sum;
}

std::vector<const Law*> LawTable::starved(std::uint64_t premises, double least_close) const {
  std::vector<const Law*> list;
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    const auto& [premise, close, broken, first_broken] = tallies_[i];
    const bool rarely_close =
        static_cast<double>(close) < least_close * static_cast<double>(premise);
    if (premise < premises || rarely_close) list.push_back(&laws()[i]);
  }
  return list;
}

std::string LawTable::text() const {
  std::string out = fmt::format("{:<46} {:>9} {:>7} {:>7}\n", "law", "premise", "close", "broken");
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    const auto& tally = tallies_[i];
    const double share = tally.premise == 0 ? 0
                                            : 100 * static_cast<double>(tally.close) /
                                                  static_cast<double>(tally.premise);
    out += fmt::format("{:<46} {:>9} {:>5.1f} % {:>7}\n", laws()[i].name, tally.premise, share,
                       tally.broken);
    if (tally.broken != 0) out += fmt::format("    {}\n", tally.first_broken);
  }
  return out;
}

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
  LawTable table, odd;
  for (const auto& family : families()) {
    for (int i = 0; i < cases_of_family; ++i) {
      const auto id = fmt::format("laws:20115:{}:{}", family.name, i);
      const JudgedCase judged(make_case(family, id).c, setting_of(id));
      CaseFacts facts = judged.facts();
      (i % 2 ? odd : table).add(facts);
    }
  }
  table.merge(odd);
  std::printf("%zu cases\n%s", cases_of_family * families().size(), table.text().c_str());
  EXPECT_EQ(table.broken(), 0u);
  for (const Law* law : table.starved(1, 0)) ADD_FAILURE() << law->name << " was never met";
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
        EXPECT_EQ(tally.broken, 0u) << law.name << ": " << tally.first_broken;
        met += tally.premise;
      }
    }
  }
  std::printf("%zu cases, premises met %llu times\n", cases.size(),
              static_cast<unsigned long long>(met));
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
