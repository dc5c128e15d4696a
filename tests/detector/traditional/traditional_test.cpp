// The traditional scheme compared with Culling::bvh, and the work that it saves.
#include "detector/traditional/traditional.h"

#include <ranges>

#include "detector/detector.h"
#include "tests/asked.h"
#include "tests/detector/search/search_meshes.h"
#include "tests/detector/traditional/patch_meshes.h"

namespace assay::detector {
namespace {

using tests::bent, tests::expect_same_contacts, tests::ramp, tests::Sheet, tests::sheet,
    tests::sphere;

using PairSet = std::set<std::pair<std::int32_t, std::int32_t>>;

StepResult step(const Triangles& rows, const Positions& x_t0, const Positions& x_t1,
                Culling culling) {
  auto detector = Detector::create(rows, x_t0, {culling});
  EXPECT_TRUE(detector.has_value());
  return detector.value().step(x_t0, x_t1);
}

PairSet candidates(const PairSearch& search, const Topology& mesh, const Positions& x_t0,
                   const Positions& x_t1) {
  BoundingVolumeTree tree(mesh, x_t0);
  const SteppedMesh motion = {x_t0, x_t1};
  PacedStop never(never_stops);
  const auto of_mesh = search.prepare(mesh, tree, never);
  of_mesh->fit(tree, mesh, motion, never);
  const Marks marks(tree);
  const PairTables tables = EveryPair().candidates();
  PairSet pairs;
  SearchCounts counts;
  of_mesh->search({mesh, tree, marks, tables}, counts, [&](std::int32_t t, std::int32_t u) {
    EXPECT_TRUE(pairs.insert(std::minmax(t, u)).second) << "twice";
    return true;
  });
  EXPECT_EQ(counts.candidate_pairs, pairs.size());
  return pairs;
}

// The directions that all these triangles face.
DirectionSet cone_of(const Sheet& mesh, const Positions& x_t1, auto&& triangles) {
  DirectionSet cone = ~DirectionSet{0};
  const SteppedMesh motion = {mesh.x, x_t1};
  for (const auto t : triangles) {
    const auto path = [&](int k) { return motion.path(mesh.rows(t, k)); };
    cone &= faced_directions({path(0), path(1), path(2)});
  }
  return cone;
}

// What bvh finds is what this finds, from fewer candidates.
TEST(Traditional, L13_AgreesWithBvhOnRandomSheets) {
  int collisions = 0, fewer = 0;
  for (std::uint64_t seed = 0; seed < tests::usual(200); ++seed) {
    tests::SearchMeshes random(seed);
    const auto mesh = random.sheets(1 + random.below(3), 1 + random.below(5), seed % 2 == 0);
    const Triangles rows = mesh.rows();
    SCOPED_TRACE(seed);
    const auto truth = step(rows, mesh.x_t0, mesh.x_t1, Culling::bvh);
    expect_same_contacts(step(rows, mesh.x_t0, mesh.x_t1, Culling::normal_cone), truth);
    collisions += truth.answer == Answer::collision;
    const auto all = candidates(TreeSearch(), mesh.topology, mesh.x_t0, mesh.x_t1);
    const auto some = candidates(NormalConeSearch(), mesh.topology, mesh.x_t0, mesh.x_t1);
    EXPECT_TRUE(std::includes(all.begin(), all.end(), some.begin(), some.end()));
    fewer += some.size() < all.size();
  }
  EXPECT_GT(collisions, tests::usual(50));
  EXPECT_GT(fewer, tests::usual(100));
}

// Quarter, half and three-quarter turns: the last has no cone as a whole.
TEST(Traditional, ABentSheetTakesATenthOfTheBoxTests) {
  for (const double angle : {0.01, 1.5, 3.0, 4.5}) {
    const Sheet before = sheet(40, 40, bent(angle));
    const Positions after = sheet(40, 40, bent(angle + 0.1)).x;
    const auto traditional = step(before.rows, before.x, after, Culling::normal_cone);
    const auto bvh = step(before.rows, before.x, after, Culling::bvh);
    expect_same_contacts(traditional, bvh);
    EXPECT_EQ(bvh.answer, Answer::free);
    EXPECT_LT(10 * traditional.counts.search.box_tests, bvh.counts.search.box_tests) << angle;
    EXPECT_LT(10 * traditional.counts.search.candidate_pairs, bvh.counts.search.candidate_pairs)
        << angle;
    EXPECT_GT(traditional.counts.search.contour_tests, 0u);
    EXPECT_EQ(traditional.view_positive + traditional.view_negative + traditional.view_zero +
                  traditional.against_all,
              0u);
  }
}

// One and a half turns, all of it facing up; the upper turn comes down on the lower one.
TEST(Traditional, L13_ARampThatWindsOverItselfIsTraversed) {
  const Sheet before = sheet(36, 2, ramp(1.5, 1.0));
  const Positions apart = sheet(36, 2, ramp(1.5, 0.9)).x, through = sheet(36, 2, ramp(1.5, -0.5)).x;
  const auto free = step(before.rows, before.x, apart, Culling::normal_cone);
  EXPECT_EQ(free.answer, Answer::free);
  EXPECT_GT(free.counts.search.box_tests, 0u);
  const auto meets = step(before.rows, before.x, through, Culling::normal_cone);
  EXPECT_EQ(meets.answer, Answer::collision);
  expect_same_contacts(meets, step(before.rows, before.x, through, Culling::bvh));
  EXPECT_NE(cone_of(before, apart, std::views::iota(0, before.rows.rows())), 0u)
      << "it has a normal cone as a whole";
}

// Half a turn less: the projection does not cross itself and nothing is traversed.
TEST(Traditional, ARampOfLessThanATurnIsNot) {
  const Sheet before = sheet(36, 2, ramp(0.9, 1.0));
  const auto result =
      step(before.rows, before.x, sheet(36, 2, ramp(0.9, 0.9)).x, Culling::normal_cone);
  EXPECT_EQ(result.answer, Answer::free);
  EXPECT_EQ(result.counts.search.box_tests, 0u);
  EXPECT_EQ(result.counts.search.contour_tests, 1u);
}

TEST(Traditional, HalvesOfASphereHaveNormalCones) {
  const Sheet before = sphere(16, 1);
  const Positions after = sphere(16, 1.1).x;
  const auto result = step(before.rows, before.x, after, Culling::normal_cone);
  const auto bvh = step(before.rows, before.x, after, Culling::bvh);
  EXPECT_EQ(result.answer, Answer::free);
  expect_same_contacts(result, bvh);
  EXPECT_LT(5 * result.counts.search.candidate_pairs, bvh.counts.search.candidate_pairs);
  const Topology mesh = make_topology(before.rows, before.x.rows());
  const BoundingVolumeTree tree(mesh, before.x);
  ContourMaker maker(mesh);
  const PatchContours contours(mesh, tree, maker);
  EXPECT_TRUE(contours.of(BoundingVolumeTree::root).empty());
  const auto child = tree.child(BoundingVolumeTree::root);
  for (const auto half : {child, child + 1}) {
    EXPECT_FALSE(contours.of(half).empty());
    std::vector<std::int32_t> triangles, below = {half};
    for (std::size_t i = 0; i < below.size(); ++i) {
      const auto node = below[i];
      if (tree.is_leaf(node)) triangles.push_back(tree.triangle(node));
      if (!tree.is_leaf(node)) below.insert(below.end(), {tree.child(node), tree.child(node) + 1});
    }
    EXPECT_NE(cone_of(before, after, triangles), 0u);
  }
}

}  // namespace
}  // namespace assay::detector
