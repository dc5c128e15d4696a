// The exact gap of a query to each degeneracy: 0 at it, and shrinking towards it.
#include <gtest/gtest.h>

#include <cmath>

#include "properties/queries/query_families.h"
#include "properties/search/degeneracy.h"

namespace assay::properties {
namespace {

using detector::FourPoints;

// A vertex that falls at the place (x,y) onto the face (-4,-4) (4,-4) (0,4) of height 0.
FourPoints falling(double x, double y, double from, double to) {
  const auto fixed = [](double a, double b) { return detector::MovingPoint{{a, b, 0}, {a, b, 0}}; };
  return {
      {detector::MovingPoint{{x, y, from}, {x, y, to}}, fixed(-4, -4), fixed(4, -4), fixed(0, 4)},
      1};
}

TEST(Gap, IsZeroAtTheEndOfAFeature) {
  EXPECT_EQ(gap_of(falling(0, -4, 1, -1), 0.5)[Hardness::side], 0);
  EXPECT_EQ(gap_of(falling(0, 4, 1, -1), 0.5)[Hardness::side], 0);
  EXPECT_GT(gap_of(falling(0, -1, 1, -1), 0.5)[Hardness::side], 0.1);
}

TEST(Gap, IsZeroAtTheEndOfTheStep) {
  EXPECT_EQ(gap_of(falling(0, -1, 1, 0), 1)[Hardness::end_of_step], 0);
  EXPECT_EQ(gap_of(falling(0, -1, 0, 1), 0)[Hardness::end_of_step], 0);
  EXPECT_GT(gap_of(falling(0, -1, 1, -1), 0.5)[Hardness::end_of_step], 0.1);
  // A root at the end of the step beside the face is none of a contact.
  EXPECT_GT(gap_of(falling(0, 8, 1, 0), 1)[Hardness::end_of_step], 0.1);
}

TEST(Gap, IsZeroForWhatStaysCoplanar) {
  EXPECT_EQ(gap_of(falling(0, -1, 0, 0), 0)[Hardness::flat], 0);
  EXPECT_EQ(gap_of(falling(0, -1, 1, -1), 0.5)[Hardness::flat] < 0.01, false);
}

TEST(Gap, IsZeroWithoutArea) {
  FourPoints q = falling(0, -1, 1, -1);
  q.points[3] = {{0, -4, 0}, {0, -4, 0}};
  EXPECT_EQ(gap_of(q, 0.5)[Hardness::no_area], 0);
  EXPECT_GT(gap_of(falling(0, -1, 1, -1), 0.5)[Hardness::no_area], 0.1);
  FourPoints edges = falling(0, 0, 1, -1);  // the first edge goes along the second
  edges.first_group = 2;
  edges.points[1] = {{1, 2, 1}, {1, 2, -1}};
  edges.points[2] = {{-4, -4, 0}, {-4, -4, 0}};
  edges.points[3] = {{-2, 0, 0}, {-2, 0, 0}};
  EXPECT_EQ(gap_of(edges, 0.5)[Hardness::no_area], 0);
  edges.points[3] = {{-2, 1, 0}, {-2, 1, 0}};
  EXPECT_GT(gap_of(edges, 0.5)[Hardness::no_area], 0.01);
}

// The vertex follows a parabola relative to the corner that rises: it touches at t = 1/2.
FourPoints grazing(double above) {
  FourPoints q = falling(0, 0, 0, 0);
  q.points[1] = {{-1, 0, 0}, {-1, 0, 0}};
  q.points[2] = {{1, 0, 0}, {1, 0, 0}};
  q.points[3] = {{0, 4, 0}, {0, 4, 4}};  // the plane rises by t y
  q.points[0] = {{0, 1, 0.25 + above}, {0, 0, 0.25 + above}};
  return q;
}

TEST(Gap, IsZeroAtADoubleRoot) {
  EXPECT_EQ(gap_of(grazing(0), 0.5)[Hardness::double_root], 0);
  EXPECT_GT(gap_of(grazing(0.125), 0.5)[Hardness::double_root], 0.001);
}

TEST(Gap, ShrinksTowardsADegeneracy) {
  double before = 2;
  for (int bits = 2; bits < 45; bits += 3) {
    const double root = gap_of(grazing(-std::ldexp(1.0, -bits)), 0.5)[Hardness::double_root];
    EXPECT_LT(root, before) << bits;
    EXPECT_GT(root, 0) << bits;
    before = root;
  }
  EXPECT_GT(nearness(gap_of(grazing(-0x1p-40), 0.5)), nearness(gap_of(grazing(-0x1p-20), 0.5)));
}

TEST(Gap, GoesByTheDistanceThatIsAskedAbout) {
  const FourPoints q = falling(0, -1, 1, 0.5);
  EXPECT_EQ(gap_of(q, 1, 0.5)[Hardness::distance], 0);
  EXPECT_GT(gap_of(q, 1, 0.25)[Hardness::distance], 0.1);
}

// Every share is one, for every query of every family.
TEST(Gap, IsAShareForEveryQuery) {
  for (const auto& family : query_generators()) {
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Gap gap = gap_of(family.make(7, i).query, 0.5);
      for (const double share : gap.share) {
        ASSERT_GE(share, 0) << family.name << " " << i;
        ASSERT_LE(share, 1) << family.name << " " << i;
      }
      const double near = nearness(gap);
      ASSERT_GE(near, 0) << family.name << " " << i;
      ASSERT_LE(near, 96) << family.name << " " << i;
    }
  }
}

}  // namespace
}  // namespace assay::properties
