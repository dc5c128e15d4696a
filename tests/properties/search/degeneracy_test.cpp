// Newton steps arrive at each degeneracy alone, and at two degeneracies at once, and move only the
// places that may move.
#include "properties/search/degeneracy.h"

#include "properties/queries/query_families.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

FourPoints generic(std::uint64_t i) { return query_families()[8].query(5, i).query; }

// The volume of the four points at this time over that of a cube of their largest coordinate.
double relative_volume(const FourPoints& q, double time) {
  double largest = 0;
  for (const auto& p : q.points)
    for (std::size_t k = 0; k < 3; ++k)
      largest = std::max({largest, std::abs(p.t0[k]), std::abs(p.t1[k])});
  return std::abs(coplanarity_at(q, time)) / (largest * largest * largest);
}

// How many of 100 generic queries arrive, by the exact gap.
int arrive(std::span<const DegeneracyAt> goals, Hardness kind, double time) {
  int arrived = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto moved = moved_onto(generic(i), goals);
    arrived += moved && gap_of(*moved, time)[kind] < 1e-9 ? 1 : 0;
  }
  return arrived;
}

TEST(Degeneracy, EachIsReachedFromGenericQueries) {
  // A side that is 0 is the end of a feature where the other sides agree in sign.
  const DegeneracyAt root[] = {{Degeneracy::coplanar, 1, 0}, {Degeneracy::side, 1, 1}};
  EXPECT_GE(arrive(root, Hardness::side, 1), 12);
  const DegeneracyAt flat[] = {{Degeneracy::flat, 0, 0}};
  EXPECT_GE(arrive(flat, Hardness::flat, 0.5), 80);
  const DegeneracyAt normal[] = {{Degeneracy::no_normal, 0.5, 0}};
  EXPECT_GE(arrive(normal, Hardness::no_area, 0.5), 80);
}

TEST(Degeneracy, ARootIsWhereItIsWanted) {
  for (const double t : {0.0, 0.25, 1.0}) {
    const DegeneracyAt goals[] = {{Degeneracy::coplanar, t, 0}};
    int arrived = 0;
    for (std::uint64_t i = 0; i < 50; ++i) {
      const auto moved = moved_onto(generic(i), goals);
      if (!moved) continue;
      ++arrived;
      EXPECT_LT(relative_volume(*moved, t), 1e-11) << i;
    }
    EXPECT_GE(arrived, 45) << t;
  }
}

TEST(Degeneracy, TwoAreReachedAtOnce) {
  const DegeneracyAt goals[] = {{Degeneracy::double_root, 0.5, 0}, {Degeneracy::side, 0.5, 2}};
  int reached = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto moved = moved_onto(generic(i), goals);
    if (!moved) continue;
    const Gap gap = gap_of(*moved, 0.5);
    const bool is_double = relative_volume(*moved, 0.5) < 1e-11;
    reached += is_double && gap[Hardness::side] < 1e-9 ? 1 : 0;
  }
  EXPECT_GE(reached, 12);
}

TEST(Degeneracy, OnlyWhatMayMoveMoves) {
  constexpr unsigned end_of_point_2 = 0x40;
  const DegeneracyAt goals[] = {{Degeneracy::coplanar, 0.75, 0}};
  for (std::uint64_t i = 0; i < 50; ++i) {
    const FourPoints q = generic(i);
    const auto moved = moved_onto(q, goals, end_of_point_2);
    if (!moved) continue;
    for (std::size_t p = 0; p < 4; ++p) {
      EXPECT_EQ(moved->points[p].t0, q.points[p].t0) << i;
      EXPECT_EQ(moved->points[p].t1 == q.points[p].t1, p != 2) << i << " " << p;
    }
  }
}

TEST(Degeneracy, ARootThatDoublesSeeIsFound) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    const FourPoints q = generic(i);
    const auto root = root_of(q);
    const bool changes = coplanarity_at(q, 0) * coplanarity_at(q, 1) < 0;
    EXPECT_TRUE(root || !changes) << i;
    EXPECT_LT(root ? relative_volume(q, *root) : 0, 1e-9) << i;
  }
}

// The exact gap of a query to each degeneracy: 0 at it, and shrinking towards it.

// A vertex that falls at the place (x,y) onto the face (-4,-4) (4,-4) (0,4) of height 0.
FourPoints falling(double x, double y, double from, double to) {
  const auto fixed = [](double a, double b) { return detector::MovingPoint{{a, b, 0}, {a, b, 0}}; };
  return {
      {detector::MovingPoint{{x, y, from}, {x, y, to}}, fixed(-4, -4), fixed(4, -4), fixed(0, 4)},
      1};
}

TEST(Gap, IsZeroAtTheEndOfAFeatureOrOfTheStepAndForWhatStaysCoplanar) {
  const Gap inside = gap_of(falling(0, -1, 1, -1), 0.5);
  EXPECT_EQ(gap_of(falling(0, -4, 1, -1), 0.5)[Hardness::side], 0);
  EXPECT_EQ(gap_of(falling(0, 4, 1, -1), 0.5)[Hardness::side], 0);
  EXPECT_GT(inside[Hardness::side], 0.1);
  EXPECT_EQ(gap_of(falling(0, -1, 1, 0), 1)[Hardness::end_of_step], 0);
  EXPECT_EQ(gap_of(falling(0, -1, 0, 1), 0)[Hardness::end_of_step], 0);
  EXPECT_GT(inside[Hardness::end_of_step], 0.1);
  // A root at the end of the step beside the face is none of a contact.
  EXPECT_GT(gap_of(falling(0, 8, 1, 0), 1)[Hardness::end_of_step], 0.1);
  EXPECT_EQ(gap_of(falling(0, -1, 0, 0), 0)[Hardness::flat], 0);
  EXPECT_GE(inside[Hardness::flat], 0.01);
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

TEST(Gap, IsZeroAtADoubleRootAndShrinksTowardsIt) {
  EXPECT_EQ(gap_of(grazing(0), 0.5)[Hardness::double_root], 0);
  EXPECT_GT(gap_of(grazing(0.125), 0.5)[Hardness::double_root], 0.001);
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
  for (const auto& family : self_test_queries()) {
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Gap gap = gap_of(family.query(7, i).query, 0.5);
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
