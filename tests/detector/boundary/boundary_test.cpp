#include "detector/boundary/boundary_handler.h"
#include "detector/boundary/ghost_sweep.h"
#include "detector/detector.h"
#include "detector/search/pair_rule.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions;

// The octahedron without the triangles given.
Triangles without(std::vector<Eigen::Index> holes) {
  const Triangles all = octahedron();
  Triangles left(all.rows() - static_cast<Eigen::Index>(holes.size()), 3);
  Eigen::Index row = 0;
  for (Eigen::Index t = 0; t < all.rows(); ++t) {
    if (std::find(holes.begin(), holes.end(), t) == holes.end()) left.row(row++) = all.row(t);
  }
  return left;
}

TEST(Loops, ACycleHasNone) {
  EXPECT_TRUE(boundary_loops(make_topology(octahedron(), 6)).empty());
  EXPECT_TRUE(make_surface(octahedron(), 6).is_closed());
}

TEST(Loops, AHoleIsOneLoopAndItsGhostsCloseTheMesh) {
  const Surface surface = make_surface(without({0}), 6);
  ASSERT_EQ(surface.loops.size(), 1u);
  EXPECT_EQ(surface.loops[0].size(), 3u);
  EXPECT_EQ(surface.ghost_count(), 3u);
  EXPECT_TRUE(surface.all().components[0].is_cycle);
  EXPECT_EQ(surface.all().triangles.back()[2], 6) << "the apex comes after the mesh's vertices";
}

TEST(Loops, AVertexOfTwoHolesIsPassedTwice) {
  // Opposite triangles at vertex 4.
  const Triangles all = octahedron();
  std::vector<Eigen::Index> at_vertex;
  for (Eigen::Index t = 0; t < all.rows(); ++t) {
    if ((all.row(t).array() == 4).any()) at_vertex.push_back(t);
  }
  ASSERT_EQ(at_vertex.size(), 4u);
  const Surface surface = make_surface(without({at_vertex[0], at_vertex[2]}), 6);
  std::size_t edges = 0;
  for (const auto& loop : surface.loops) edges += loop.size();
  EXPECT_EQ(edges, 6u);
  EXPECT_TRUE(surface.all().components[0].is_cycle);
}

TEST(Loops, AFlippedTriangleIsClosedTwiceOver) {
  Triangles t = octahedron();
  std::swap(t(0, 1), t(0, 2));
  const Surface surface = make_surface(t, 6);
  EXPECT_EQ(surface.ghost_count(), 6u) << "each of its edges is used twice in one direction";
  EXPECT_TRUE(surface.all().components[0].is_cycle);
}

TEST(Apex, StandsOverTheCentroidAlongTheNormal) {
  const Positions x = tests::positions({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}});
  const Loop loop = {0, 1, 2, 3};
  EXPECT_EQ(place_apex({0}, loop, x), (Point{1.5, 2, 0}));
  EXPECT_EQ(place_apex({1}, loop, x), (Point{1.5, 2, 5})) << "one diagonal of the loop's box";
  EXPECT_EQ(place_apex({-0.25}, loop, x), (Point{1.5, 2, -1.25}));
}

// So far away a centroid is rounded to 2^-12, which must not weigh on the normal.
TEST(Apex, OfALoopFarAwayIsThatOfTheSameLoopNearby) {
  const Positions near = tests::positions({{0, 0, 0}, {3, 0, 0}, {4, 2, 0}, {2, 5, 0}, {0, 3, 0}});
  const Loop loop = {0, 1, 2, 3, 4};
  const double far = 0x1p40;
  const Positions away = near.array() + far;
  const Point a = place_apex({1}, loop, near), b = place_apex({1}, loop, away);
  EXPECT_GT(a[2], 5);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(b[k] - far, a[k], .02) << k;
}

TEST(Apex, IsFiniteForEveryFiniteLoop) {
  constexpr double huge = std::numeric_limits<double>::max(), tiny = 0x1p-1074;
  for (const double s : {huge, tiny, 0.0}) {
    const Positions x = tests::positions({{-s, 0, 0}, {s, -s, 0}, {s, s, s}});
    for (const auto& rule : apex_rules) {
      for (const double c : place_apex(rule, {0, 1, 2}, x)) EXPECT_TRUE(std::isfinite(c)) << s;
    }
  }
  // The sum of the rounded terms overflows for some numbers of vertices, of which 11 is the least.
  for (int count = 3; count <= 50; ++count) {
    Loop loop;
    for (int v = 0; v < count; ++v) loop.push_back(v);
    for (const double reach : {0.0, 1.0, huge}) {
      Positions x(count, 3);
      for (int v = 0; v < count; ++v) x.row(v) << huge, -huge, v % 2 == 0 ? reach : -reach;
      for (const auto& rule : apex_rules) {
        for (const double c : place_apex(rule, loop, x))
          EXPECT_TRUE(std::isfinite(c)) << count << " vertices, " << reach;
      }
    }
  }
}

// Each by its own rule at both ends of a step: where it stood at the end of the one before.
// A loop that is long along one axis alone, whichever that is.
TEST(Apex, IsFiniteForEveryLongLoop) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const double length : {1e100, 1e200, 1e307}) {
      Positions x = tests::positions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}});
      x(1, axis) = length;
      x(2, axis) = -length;
      for (const auto& rule : apex_rules) {
        for (const double c : place_apex(rule, {0, 1, 2, 3}, x))
          EXPECT_TRUE(std::isfinite(c)) << axis << " " << length;
      }
    }
  }
}

TEST(Apex, OfEachHoleIsPlacedByTheRuleOfThatHole) {
  const Surface surface = make_surface(without({0, 6}), 6);
  ASSERT_EQ(surface.loops.size(), 2u);
  const Positions x_t0 = octahedron_positions(2), x_t1 = octahedron_positions(3);
  const std::vector<ApexRule> rules = {{0.0}, {0.25}};
  const BoundaryHandler handler;
  const auto step = handler.place_apexes(surface, rules, {x_t0, x_t1}),
             next = handler.place_apexes(surface, rules, {x_t1, x_t0});
  for (std::size_t l = 0; l < 2; ++l) {
    EXPECT_EQ(step[l].t0, place_apex(rules[l], surface.loops[l], x_t0));
    EXPECT_EQ(step[l].t1, next[l].t0);
    EXPECT_EQ(step[l].t0, next[l].t1);
  }
}

// A flat sheet is cut by the fan from its centroid; a raised apex touches nothing.
TEST(Apex, TheRuleThatTouchesLeastIsTaken) {
  Triangles t(18, 3);
  Positions x(16, 3);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) x.row(4 * i + j) << i, j, 0;
  }
  Eigen::Index row = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int v = 4 * i + j;
      t.row(row++) << v, v + 4, v + 5;
      t.row(row++) << v, v + 5, v + 1;
    }
  }
  auto made = Detector::create(t, x, {Culling::view_point, Start::verified, Pairs::all});
  const StepResult result = made.value().step(x, x);
  EXPECT_EQ(result.violated, 0u);
  EXPECT_EQ(result.dirty, 0u);
  EXPECT_EQ(result.answer, Answer::free);
  ASSERT_EQ(result.apexes.size(), 1u);
  EXPECT_NE(result.apexes[0].t0[2], 0);
}

// The vertex opposite to the hole goes out through it: the ghosts see it pass.
TEST(GhostSweep, L11_WhatPassesTheHoleIsViolatedAndStaysDirty) {
  const Triangles t = without({0});
  const Positions x_t0 = octahedron_positions(2);
  const Eigen::RowVector3d out =
      x_t0.row(octahedron()(0, 0)) + x_t0.row(octahedron()(0, 1)) + x_t0.row(octahedron()(0, 2));
  Positions x_t1 = x_t0;
  for (Eigen::Index v = 0; v < 6; ++v) {
    if ((octahedron().row(0).array() == static_cast<std::int32_t>(v)).any()) continue;
    x_t1.row(v) = out;
    break;
  }
  auto made = Detector::create(t, x_t0, {Culling::view_point, Start::verified, Pairs::all});
  auto& detector = made.value();
  EXPECT_EQ(detector.step(x_t0, x_t0).violated, 0u);
  const StepResult passing = detector.step(x_t0, x_t1);
  EXPECT_GE(passing.violated, 1u);
  EXPECT_EQ(passing.dirty, 0u);
  const StepResult outside = detector.step(x_t1, x_t1);
  EXPECT_GE(outside.dirty, passing.violated) << "carried to the next step";
  for (std::size_t i = 0; i < outside.doubts.size(); ++i) {
    if (passing.doubts[i] & doubt::violated) {
      EXPECT_TRUE(outside.doubts[i] & doubt::dirty);
    }
  }
}

TEST(PairTable, L3_AsksForKAndNothingElse) {
  const PairTables k = PairRule().candidates();
  const std::uint8_t sets[] = {flag::positive, flag::negative, flag::zero, flag::violated};
  for (const auto a : sets) {
    for (const auto b : sets) {
      const bool same_sign = a == b && (a == flag::positive || a == flag::negative);
      EXPECT_EQ(k.within.asks(a, b), !same_sign);
      EXPECT_TRUE(k.across.asks(a, b)) << "L10";
    }
  }
  EXPECT_TRUE(k.within.asks(flag::positive, flag::positive | flag::negative)) << "of a node";
  EXPECT_FALSE(k.within.asks(flag::positive, 0));
}

TEST(PairTable, RemovingIsTheInverseOfAdding) {
  PairTable table = PairTable::everything();
  table.remove(flag::zero, flag::violated);
  EXPECT_FALSE(table.asks(flag::zero, flag::violated));
  EXPECT_FALSE(table.asks(flag::violated, flag::zero));
  EXPECT_TRUE(table.asks(flag::zero | flag::positive, flag::violated));
}

}  // namespace
}  // namespace assay::detector
