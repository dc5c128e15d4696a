#include "oracle/view/view_sign.h"
#include "tests/test.h"

namespace assay::oracle {
namespace {

using detector::ViewSign;
constexpr ViewSign P = ViewSign::positive, M = ViewSign::negative, Z = ViewSign::zero;

TEST(Candidates, BySigns) {
  const Candidates k({P, P, M, M, Z, Z}, {});
  EXPECT_TRUE(k.holds({0, 2}));   // (V+,V-)
  EXPECT_FALSE(k.holds({0, 1}));  // (V+,V+)
  EXPECT_FALSE(k.holds({2, 3}));  // (V-,V-)
  EXPECT_TRUE(k.holds({0, 4}));   // (U,V0)
  EXPECT_TRUE(k.holds({2, 4}));
  EXPECT_TRUE(k.holds({4, 5}));  // V0 is in U
}

TEST(Candidates, ViolatedMeetAll) {
  const Candidates k({P, P, P, P}, {0, 1, 1, 0});
  EXPECT_TRUE(k.holds({0, 1}));
  EXPECT_TRUE(k.holds({1, 2}));  // Vv is in U
  EXPECT_FALSE(k.holds({0, 3}));
}

TEST(Candidates, L10_PairsOfTwoGroups) {
  const Candidates k({P, P, P}, {}, {0, 0, 1});
  EXPECT_FALSE(k.holds({0, 1}));
  EXPECT_TRUE(k.holds({1, 2}));
}

TEST(Candidates, SplitKeepsOrder) {
  const std::vector<detector::PairContact> pairs = {
      {{0, 1}, {0.25, 0.25}, {}}, {{0, 2}, {0.5, 0.5}, {}}, {{1, 2}, {0.25, 0.25}, {}}};
  const Candidates k({P, P, M}, {});
  const PairSplit parts = split(pairs, k);
  ASSERT_EQ(parts.in_k.size(), 2u);
  EXPECT_EQ(parts.in_k[0].pair, (detector::TrianglePair{0, 2}));
  EXPECT_EQ(parts.in_k[1].pair, (detector::TrianglePair{1, 2}));
  ASSERT_EQ(parts.outside.size(), 1u);
  EXPECT_TRUE(holds_a_first_contact(pairs, k));
  EXPECT_FALSE(holds_a_first_contact({pairs[0], pairs[1]}, k));
  EXPECT_TRUE(holds_a_first_contact({}, k));
}

}  // namespace
}  // namespace assay::oracle
