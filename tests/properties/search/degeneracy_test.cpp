// Newton steps arrive at each degeneracy, alone and two at once, and move only what they may.
#include "properties/search/degeneracy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "properties/queries/query_families.h"

namespace assay::properties {
namespace {

using detector::FourPoints;

FourPoints generic(std::uint64_t i) { return query_generators()[8].make(5, i).query; }

// The volume of the four points at this time over that of a cube of their largest coordinate.
double relative_volume(const FourPoints& q, double time) {
  double largest = 0;
  for (const auto& p : q.points) {
    for (std::size_t k = 0; k < 3; ++k)
      largest = std::max({largest, std::abs(p.t0[k]), std::abs(p.t1[k])});
  }
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

}  // namespace
}  // namespace assay::properties
