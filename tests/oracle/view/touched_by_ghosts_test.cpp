#include "oracle/view/touched_by_ghosts.h"

#include "oracle/mesh/mesh_features.h"
#include "oracle/mesh/step.h"
#include "tests/oracle/random_points.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using detector::Positions, detector::Triangles, test::positions, test::triangles;
using Flags = std::vector<std::uint8_t>;

// An open box without its top (triangles 0 to 9), 8 vertices, and ghosts over the loop 4 5 6 7.
const Triangles box_triangles =
    tests::triangles_of("0 2 1, 0 3 2, 0 1 5, 0 5 4, 1 2 6, 1 6 5, 2 3 7, 2 7 6, 3 0 4, 3 4 7");

Positions box() {
  return tests::positions_of("-4 -4 -4, 4 -4 -4, 4 4 -4, -4 4 -4, -4 -4 4, 4 -4 4, 4 4 4, -4 4 4");
}

Flags touched(const Positions& x_t0, const Positions& x_t1, const Triangles& f,
              const Positions& apex_t0, const Positions& apex_t1, bool static_at_start = false) {
  const auto vertices = static_cast<std::int32_t>(x_t0.rows());
  const Triangles ghosts = ghost_triangles(boundary_loops(f), vertices);
  return touched_by_ghosts({x_t0, x_t1}, f, apex_t0, apex_t1, ghosts, static_at_start);
}

int count(const Flags& flags) { return std::accumulate(flags.begin(), flags.end(), 0); }

TEST(TouchedByGhosts, LidTouchesNothingUntilItsApexComesThroughTheBottom) {
  const auto apex = positions({{0, 0, 4}});
  EXPECT_EQ(count(touched(box(), box(), box_triangles, apex, apex, true)), 0);
  // From t=8/9 on.
  const Flags flags =
      touched(box(), box(), box_triangles, positions({{1, 0, 4}}), positions({{1, 0, -5}}));
  EXPECT_EQ(flags, (Flags{1, 1, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(TouchedByGhosts, InThePlaneOfTheLoop) {
  // The apex leaves the box in the plane of its top: the ghosts cross the edge 56 of the loop,
  // which the triangle 165 holds, through features that they do not share with it.
  const auto inside = positions({{0, 3, 4}}), outside = positions({{9, 3, 4}});
  EXPECT_EQ(count(touched(box(), box(), box_triangles, inside, inside)), 0);
  const Flags flags = touched(box(), box(), box_triangles, inside, outside);
  EXPECT_EQ(flags[5], 1);
  EXPECT_EQ(flags[0], 0);
}

TEST(TouchedByGhosts, OnlyDuringTheStep) {
  // A small triangle passes through the lid and back out beside the box: clear at both ends.
  Positions x_t0(11, 3), x_t1(11, 3);
  x_t0 << box(), positions({{-2, 0, 5}, {-1.5, 0, 5}, {-2, 0.5, 5}});
  x_t1 << box(), positions({{6, 0, -1}, {6.5, 0, -1}, {6, 0.5, -1}});
  Triangles f(11, 3);
  f << box_triangles, triangles({{8, 9, 10}});
  const Triangles ghosts = ghost_triangles({{4, 7, 6, 5}}, 11);
  const auto apex = positions({{0, 0, 4}});
  EXPECT_EQ(count(touched_by_ghosts({x_t0, x_t0}, f, apex, apex, ghosts, true)), 0);
  EXPECT_EQ(count(touched_by_ghosts({x_t1, x_t1}, f, apex, apex, ghosts, true)), 0);
  const Flags flags = touched_by_ghosts({x_t0, x_t1}, f, apex, apex, ghosts);
  EXPECT_EQ(count(flags), 1);
  EXPECT_EQ(flags[10], 1);
}

TEST(TouchedByGhosts, NextToTheLoop) {
  // One triangle and its three ghosts; the apex passes through it. Each ghost shares an edge with
  // it, and touches it with its apex alone.
  const auto x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  const Triangles f = triangles({{0, 1, 2}});
  EXPECT_EQ(touched(x, x, f, positions({{1, 1, 1}}), positions({{1, 1, -1}})), Flags{1});
  EXPECT_EQ(touched(x, x, f, positions({{5, 5, 1}}), positions({{5, 5, 9}})), Flags{0});
  EXPECT_EQ(touched(x, x, f, positions({{1, 1, 1}}), positions({{1, 1, 0}})), Flags{1});
}

TEST(TouchedByGhosts, DegenerateGhosts) {
  // The apex lies on an edge of the loop: one ghost is a segment, which touches the triangle.
  const auto x = positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  const Triangles f = triangles({{0, 1, 2}});
  // So it does from a corner, and in line with the edge, beyond its end.
  for (const double at : {2, 4, 6}) {
    const auto apex = positions({{at, 0, 0}});
    EXPECT_EQ(touched(x, x, f, apex, apex), Flags{1}) << at;
  }
}

TEST(TouchedByGhosts, PiercingAtTheStartOnRequest) {
  // A spike through the lid, at rest: no vertex and no edge of one touches the other.
  Positions x(11, 3);
  x << box(), positions({{1, 0.2, 0}, {1, 0.2, 8}, {1.5, 0.3, 8}});
  Triangles f(11, 3);
  f << box_triangles, triangles({{8, 9, 10}});
  const Triangles ghosts = ghost_triangles({{4, 7, 6, 5}}, 11);
  const auto apex = positions({{0, 0, 4}});
  EXPECT_EQ(count(touched_by_ghosts({x, x}, f, apex, apex, ghosts)), 0);
  const Flags flags = touched_by_ghosts({x, x}, f, apex, apex, ghosts, true);
  EXPECT_EQ(count(flags), 1);
  EXPECT_EQ(flags[10], 1);
}

// Against judge_step on mesh and ghosts as one mesh: the same triangles, for every kind of numbers.
TEST(TouchedByGhosts, L11_AreThoseInContactWithAGhost) {
  test::Random random(41);
  int some = 0;
  for (int i = 0; i < 400; ++i) {
    const auto kind = static_cast<test::Coordinates>(i % test::coordinate_kinds);
    const int vertices = 8, triangle_count = 5;
    const Triangles f = random_triangles(random, vertices, triangle_count);
    const auto loops = boundary_loops(f);
    const Triangles ghosts = ghost_triangles(loops, vertices);
    const auto apexes = static_cast<Eigen::Index>(loops.size());
    Positions all_t0(vertices + apexes, 3), all_t1(vertices + apexes, 3);
    for (Eigen::Index v = 0; v < all_t0.rows(); ++v) {
      const auto p = test::random_point(random, kind);
      const bool rests = random.below(3) == 0;
      for (int k = 0; k < 3; ++k) {
        all_t0(v, k) = p.t0[k];
        all_t1(v, k) = rests ? p.t0[k] : p.t1[k];
      }
    }
    Triangles all(f.rows() + ghosts.rows(), 3);
    all << f, ghosts;
    Flags with_piercing(triangle_count, 0);
    Flags swept_at_least(triangle_count, 0);
    for (const auto& contact : judge_step({all_t0, all_t1}, all, {}).pairs) {
      if (contact.pair.a >= triangle_count || contact.pair.b < triangle_count) continue;
      with_piercing[contact.pair.a] = 1;
      if (contact.feature.kind != detector::FeatureKind::piercing) {
        swept_at_least[contact.pair.a] = 1;
      }
    }
    const Positions x_t0 = all_t0.topRows(vertices), x_t1 = all_t1.topRows(vertices);
    const Positions apex_t0 = all_t0.bottomRows(apexes), apex_t1 = all_t1.bottomRows(apexes);
    EXPECT_EQ(touched_by_ghosts({x_t0, x_t1}, f, apex_t0, apex_t1, ghosts, true), with_piercing);
    const Flags swept = touched_by_ghosts({x_t0, x_t1}, f, apex_t0, apex_t1, ghosts);
    for (int t = 0; t < triangle_count; ++t) {
      EXPECT_LE(swept_at_least[t], swept[t]);
      EXPECT_LE(swept[t], with_piercing[t]);
    }
    some += count(swept) > 0 && count(swept) < triangle_count;
  }
  EXPECT_GT(some, 40);
}

}  // namespace
}  // namespace assay::oracle
