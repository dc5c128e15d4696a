// Loops, apexes and ghosts of open meshes.
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
  const Surface surface = make_surface(without({0, 2}), 6);
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

void expect_finite_apexes(const Loop& loop, const Positions& x) {
  for (const auto& rule : apex_rules) {
    for (const double c : place_apex(rule, loop, x)) EXPECT_TRUE(std::isfinite(c)) << x;
  }
}

TEST(Apex, IsFiniteForEveryFiniteLoop) {
  constexpr double huge = std::numeric_limits<double>::max(), tiny = 0x1p-1074;
  for (const double s : {huge, tiny, 0.0})
    expect_finite_apexes({0, 1, 2}, tests::positions({{-s, 0, 0}, {s, -s, 0}, {s, s, s}}));
  // The sum of the rounded terms overflows for some numbers of vertices, of which 11 is the least.
  for (int count = 3; count <= 50; ++count) {
    Loop loop;
    for (int v = 0; v < count; ++v) loop.push_back(v);
    for (const double reach : {0.0, 1.0, huge}) {
      Positions x(count, 3);
      for (int v = 0; v < count; ++v) x.row(v) << huge, -huge, v % 2 == 0 ? reach : -reach;
      expect_finite_apexes(loop, x);
    }
  }
}

// A loop that is long along one axis alone, whichever that is.
TEST(Apex, IsFiniteForEveryLongLoop) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const double length : {1e100, 1e200, 1e307}) {
      Positions x = tests::positions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}});
      x(1, axis) = length;
      x(2, axis) = -length;
      expect_finite_apexes({0, 1, 2, 3}, x);
    }
  }
}

// Each by its own rule at both ends of a step: where it stood at the end of the one before.
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
  const Positions x = tests::flat_squares(3);
  auto detector =
      Detector::create(tests::squares(3, 3), x, {Culling::view_point, Start::verified, Pairs::all});
  const StepResult result = detector.value().step(x, x);
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
  Positions x_t1 = x_t0;
  x_t1.row(1) << 2, 2, 2;
  auto result = Detector::create(t, x_t0, {Culling::view_point, Start::verified, Pairs::all});
  auto& detector = result.value();
  EXPECT_EQ(detector.step(x_t0, x_t0).violated, 0u);
  const StepResult passing = detector.step(x_t0, x_t1);
  EXPECT_GE(passing.violated, 1u);
  EXPECT_EQ(passing.dirty, 0u);
  const StepResult outside = detector.step(x_t1, x_t1);
  EXPECT_GE(outside.dirty, passing.violated) << "carried to the next step";
  for (std::size_t i = 0; i < outside.doubts.size(); ++i)
    EXPECT_TRUE(!(passing.doubts[i] & doubt::violated) || outside.doubts[i] & doubt::dirty);
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

// What choosing apexes costs, counted in operations: linear in the triangles, whatever their loops.

struct Mesh {
  Triangles triangles;
  Positions x;
};

// n triangles around a hub, with a gap: one loop through the hub and all of the rim.
Mesh open_fan(int n) {
  Mesh fan{Triangles(n, 3), Positions(n + 2, 3)};
  fan.x.row(0) << 0, 0, 0;
  for (int i = 0; i <= n; ++i) {
    const double angle = 6.28 * i / (n + 1);
    fan.x.row(i + 1) << std::cos(angle), std::sin(angle), 0.1 * std::sin(7 * i);
    if (i < n) fan.triangles.row(i) << 0, i + 1, i + 2;
  }
  return fan;
}

// n^3 triangles in a grid of cubes: each is a component, and a loop of three edges.
Mesh soup(int n) {
  const int count = n * n * n;
  Mesh all{Triangles(count, 3), Positions(3 * count, 3)};
  for (int i = 0; i < count; ++i) {
    const double x = i % n, y = i / n % n, z = i / (n * n);
    all.x.row(3 * i) << x, y, z;
    all.x.row(3 * i + 1) << x + .5 + .01 * std::sin(i), y, z + .25;
    all.x.row(3 * i + 2) << x, y + .5, z + .25 * std::cos(i);
    all.triangles.row(i) << 3 * i, 3 * i + 1, 3 * i + 2;
  }
  return all;
}

Mesh flat_sheet(int n) { return {tests::squares(n, n), tests::flat_squares(n)}; }

ApexChoice::Result choose(const Mesh& mesh, const StopFunction& stop = {}) {
  const Surface surface = make_surface(mesh.triangles, mesh.x.rows());
  BoundingVolumeTree tree(surface.mesh, mesh.x);
  tree.refit(surface.mesh, {mesh.x, mesh.x});
  tree.join_boxes(nullptr);
  return ApexChoice(surface, tree, mesh.x, ElementaryTest(), stop).run();
}

// A sweep ends a few pairs after its part is used up; each pair is 15 elementary tests at most.
constexpr std::uint64_t late = 16 * 15 * 64;

std::uint64_t most_work(const Mesh& mesh, std::size_t ghosts, std::size_t loops) {
  const auto triangles = static_cast<std::uint64_t>(mesh.triangles.rows());
  return ApexChoice::base_work + ApexChoice::work_per_triangle * (triangles + ghosts) +
         5 * apex_rules.size() * loops * late;
}

TEST(ApexChoice, OfAFanCostsLinearly) {
  int without_any = 0;
  for (const int n : {500, 1000, 2000, 4000}) {
    const Mesh fan = open_fan(n);
    const auto result = choose(fan);
    EXPECT_LE(result.counts.work(), most_work(fan, static_cast<std::size_t>(n) + 2, 1)) << n;
    ASSERT_EQ(result.rules.size(), 1u);
    if (result.cut_short < apex_rules.size()) continue;
    EXPECT_EQ(result.rules[0].height, apex_rules[0].height) << "none was followed to its end";
    ++without_any;
  }
  EXPECT_GT(without_any, 0);
}

// What one loop has used up is not there for the others.
TEST(ApexChoice, OfSeveralFansTogetherCostsLinearly) {
  constexpr int fans = 4, n = 2000;
  const Mesh fan = open_fan(n);
  Mesh all{Triangles(fans * n, 3), Positions(fans * fan.x.rows(), 3)};
  for (int i = 0; i < fans; ++i) {
    const auto first = static_cast<std::int32_t>(i * fan.x.rows());
    all.triangles.middleRows(i * n, n) = fan.triangles.array() + first;
    all.x.middleRows(first, fan.x.rows()) = fan.x.rowwise() + Eigen::RowVector3d(4 * i, 0, 0);
  }
  const auto result = choose(all);
  EXPECT_GT(result.cut_short, 0u) << "each of them would take more than its share";
  EXPECT_LE(result.counts.work(), most_work(all, fans * (n + 2), 1));
}

// Small loops come first: what they leave over is there for a large one that takes all it gets.
TEST(ApexChoice, ALargeLoopGetsWhatSmallOnesLeaveOver) {
  const Mesh fan = open_fan(2000), small = soup(9);
  Mesh all{Triangles(fan.triangles.rows() + small.triangles.rows(), 3),
           Positions(fan.x.rows() + small.x.rows(), 3)};
  all.triangles << fan.triangles, small.triangles.array() + static_cast<std::int32_t>(fan.x.rows());
  all.x << fan.x, small.x.rowwise() + Eigen::RowVector3d(4, 0, 0);
  const auto result = choose(all);
  const std::uint64_t ghosts = 2002 + 3 * 729, triangles = 2000 + 729 + ghosts;
  EXPECT_GT(result.cut_short, 0u);
  EXPECT_GE(result.counts.work(),
            (ApexChoice::base_work + ApexChoice::work_per_triangle * triangles) * 3 / 4);
}

TEST(ApexChoice, OfASoupCostsTheSameForEachTriangle) {
  const auto few = choose(soup(5)), many = choose(soup(20));
  const double of_few = static_cast<double>(few.counts.work()) / 125,
               of_many = static_cast<double>(many.counts.work()) / 8000;
  EXPECT_NEAR(of_many, of_few, .1 * of_few);
  EXPECT_EQ(few.cut_short, 0u);
}

// The fan from the centroid of a flat sheet lies upon it.
TEST(ApexChoice, AFlatSheetIsSoonKnownToLieInItsFan) {
  const auto result = choose(flat_sheet(100));
  EXPECT_EQ(result.cut_short, 0u);
  EXPECT_NE(result.rules[0].height, 0);
}

TEST(ApexChoice, AHoleThatAFewTrianglesLeaveKeepsItsCentroid) {
  const auto result = choose({octahedron().bottomRows(7), octahedron_positions(2)});
  EXPECT_EQ(result.rules[0].height, 0);
  EXPECT_EQ(result.cut_short, 0u);
}

TEST(ApexChoice, IsStopped) {
  int calls = 0;
  const auto all = choose(soup(20), [&] { return ++calls, false; });
  EXPECT_GE(static_cast<std::uint64_t>(calls), all.counts.work() / 800'000);
  EXPECT_LT(4 * choose(soup(20), [&] { return true; }).counts.work(), all.counts.work());
}

TEST(Create, IsStoppedAtEachAsking) {
  const Mesh meshes[] = {flat_sheet(60), soup(10), open_fan(1000)};
  for (const auto& mesh : meshes) {
    for (const auto culling : {Culling::view_auto, Culling::view_line, Culling::bvh}) {
      int all = 0;
      ASSERT_TRUE(
          Detector::create(mesh.triangles, mesh.x, {culling}, [&] { return ++all, false; }));
      ASSERT_GT(all, 2);
      for (int n = 1; n <= all; n += 1 + all / 10) {
        int calls = 0;
        const auto result =
            Detector::create(mesh.triangles, mesh.x, {culling}, [&] { return ++calls == n; });
        ASSERT_FALSE(result) << n << " of " << all;
        EXPECT_EQ(result.error().error, InputError::stopped);
        EXPECT_EQ(calls, n) << "and nothing is asked afterwards";
      }
    }
  }
}

// A search for a place takes as much for a component of one triangle as for one of some hundred.
// So none is made for the components of a soup, because each triangle would take the work of
// 20,000 box tests.
TEST(Create, OfASoupSearchesNoPlaceForEachTriangle) {
  for (const int n : {10, 20}) {
    const Mesh triangles = soup(n);
    for (const auto culling : {Culling::automatic, Culling::view_point, Culling::view_line}) {
      std::uint64_t calls = 0;
      ASSERT_TRUE(Detector::create(triangles.triangles, triangles.x, {culling},
                                   [&] { return ++calls, false; }));
      const auto count = static_cast<std::uint64_t>(triangles.triangles.rows());
      EXPECT_LT(calls * PacedStop::usual_interval, 4'000 * count) << n;
    }
  }
}

}  // namespace
}  // namespace assay::detector
