// What choosing apexes costs, counted in operations: linear in the triangles, whatever their loops.
#include "detector/boundary/boundary_handler.h"
#include "detector/detector.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

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

// A flat sheet of n x n squares.
Mesh sheet(int n) {
  Mesh flat{Triangles(2 * n * n, 3), Positions((n + 1) * (n + 1), 3)};
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const int v = i * (n + 1) + j;
      flat.x.row(v) << i, j, 0;
      if (i == n || j == n) continue;
      flat.triangles.row(2 * (i * n + j)) << v, v + n + 1, v + n + 2;
      flat.triangles.row(2 * (i * n + j) + 1) << v, v + n + 2, v + 1;
    }
  }
  return flat;
}

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
  const auto result = choose(sheet(100));
  EXPECT_EQ(result.cut_short, 0u);
  EXPECT_NE(result.rules[0].height, 0);
}

TEST(ApexChoice, AHoleThatAFewTrianglesLeaveKeepsItsCentroid) {
  const auto result = choose({tests::octahedron().bottomRows(7), tests::octahedron_positions(2)});
  EXPECT_EQ(result.rules[0].height, 0);
  EXPECT_EQ(result.cut_short, 0u);
}

TEST(ApexChoice, IsStopped) {
  int asked = 0;
  const auto all = choose(soup(20), [&] { return ++asked, false; });
  EXPECT_GE(static_cast<std::uint64_t>(asked), all.counts.work() / 800'000);
  const auto cut = choose(soup(20), [&] { return true; });
  EXPECT_LT(4 * cut.counts.work(), all.counts.work());
}

TEST(Create, IsStoppedAtEachAsking) {
  const Mesh meshes[] = {sheet(60), soup(10), open_fan(1000)};
  for (const auto& mesh : meshes) {
    for (const auto culling : {Culling::view_auto, Culling::view_line, Culling::bvh}) {
      int all = 0;
      ASSERT_TRUE(
          Detector::create(mesh.triangles, mesh.x, {culling}, [&] { return ++all, false; }));
      ASSERT_GT(all, 2);
      for (int n = 1; n <= all; n += 1 + all / 10) {
        int asked = 0;
        const auto made =
            Detector::create(mesh.triangles, mesh.x, {culling}, [&] { return ++asked == n; });
        ASSERT_FALSE(made) << n << " of " << all;
        EXPECT_EQ(made.error().error, InputError::stopped);
        EXPECT_EQ(asked, n) << "and nothing is asked afterwards";
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
      std::uint64_t asked = 0;
      ASSERT_TRUE(Detector::create(triangles.triangles, triangles.x, {culling},
                                   [&] { return ++asked, false; }));
      const auto count = static_cast<std::uint64_t>(triangles.triangles.rows());
      EXPECT_LT(asked * PacedStop::usual_interval, 4'000 * count) << n;
    }
  }
}

// 24 s when each ghost was swept by itself; now some 20 ms.
TEST(Create, OfAFanIsSoonDone) {
  const Mesh fan = open_fan(3000);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(Detector::create(fan.triangles, fan.x, {}));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

}  // namespace
}  // namespace assay::detector
