// Searches of the tree: by one box, and what they cost.
#include "detector/boxes/bounding_volume_tree.h"
#include "detector/search/pair_rule.h"
#include "detector/search/pair_search.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::tests {
namespace {

using detector::BoundingVolumeTree, detector::SearchCounts;

// A single box against the tree.

TEST(SearchBox, FindsWhatIsNotApartAndStopsWhenTold) {
  SearchMeshes meshes(5);
  for (int i = 0; i < 20; ++i) {
    const MovingMesh mesh = meshes.sheets(3, 4, i % 2 == 0);
    BoundingVolumeTree tree(mesh.topology, mesh.x_t0);
    tree.refit(mesh.topology, {mesh.x_t0, mesh.x_t1});
    tree.join_boxes(nullptr);
    const auto box = tree.box_of_triangle(mesh.topology.triangles[7], {mesh.x_t0, mesh.x_t1});
    std::set<std::int32_t> expected, found;
    for (std::size_t t = 0; t < mesh.topology.triangles.size(); ++t) {
      const auto triangle = static_cast<std::int32_t>(t);
      if (!apart(box, tree.box(tree.leaf_of(triangle)))) expected.insert(triangle);
    }
    SearchCounts counts;
    const auto all = [&](std::int32_t t) { return found.insert(t).second; };
    EXPECT_TRUE(search_box(tree, box, counts, all));
    EXPECT_EQ(found, expected);
    EXPECT_EQ(counts.candidate_pairs, expected.size());
    std::size_t seen = 0;
    const auto half = [&](std::int32_t) { return ++seen < (expected.size() + 1) / 2; };
    EXPECT_FALSE(search_box(tree, box, counts, half));
    EXPECT_EQ(seen, (expected.size() + 1) / 2);
  }
}

// What the tree and a search of it cost, counted.

using namespace detector;

// Triangles of no common vertex, each of size one, at the places given.
struct Scattered {
  explicit Scattered(const std::vector<Eigen::RowVector3d>& places) {
    const auto n = static_cast<Eigen::Index>(places.size());
    triangles.resize(n, 3);
    x.resize(3 * n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& place = places[static_cast<std::size_t>(i)];
      triangles.row(i) << static_cast<int>(3 * i), static_cast<int>(3 * i + 1),
          static_cast<int>(3 * i + 2);
      x.row(3 * i) = place;
      x.row(3 * i + 1) = place + Eigen::RowVector3d(1, 0, 0);
      x.row(3 * i + 2) = place + Eigen::RowVector3d(0, 1, 1);
    }
  }
  Triangles triangles;
  Positions x;
};

// All triangles are violated, as in a step without views.
SearchCounts searched(const Topology& mesh, const Positions& x, TreeSearch::Skipping skipping) {
  BoundingVolumeTree tree(mesh, x);
  tree.refit(mesh, {x, x});
  Marks marks(tree);
  MarkingCounts marking;
  Marking().bring_to(std::vector(mesh.triangles.size(), TriangleType::violated), tree, marks,
                     marking);
  const PairTable all = PairTable().add(flag::violated, flag::violated);
  SearchCounts counts;
  const auto sink = [](std::int32_t, std::int32_t) { return true; };
  EXPECT_TRUE(TreeSearch(skipping).search({mesh, tree, marks, {all, all}}, counts, sink));
  return counts;
}

// Two groups of two: the boxes of the groups are apart, and in each group those of its two.
TEST(TreeSearch, GroupsThatAreApartTakeOneBoxTest) {
  const Scattered four({{0, 0, 0}, {4, 0, 0}, {100, 0, 0}, {104, 0, 0}});
  const Topology mesh = make_topology(four.triangles, four.x.rows());
  EXPECT_EQ(searched(mesh, four.x, TreeSearch::Skipping::on).box_tests, 3u);
}

TEST(TreeSearch, NoChildrenAreCountedWhereEveryTriangleIsAskedFor) {
  SearchMeshes random(3);
  const MovingMesh mesh = random.sheets(3, 6, false);
  const auto counts = searched(mesh.topology, mesh.x_t0, TreeSearch::Skipping::on),
             without = searched(mesh.topology, mesh.x_t0, TreeSearch::Skipping::off);
  EXPECT_EQ(counts.child_counts, 0u);
  EXPECT_EQ(counts.skipped, 0u);
  EXPECT_EQ(counts.box_tests, without.box_tests);
}

// The centre of a triangle is a sum over its corners, which must not overflow.
TEST(BoundingVolumeTree, SplitsTheLargestCoordinatesAsItSplitsSmallOnes) {
  SearchMeshes random(4);
  const MovingMesh mesh = random.sheets(1, 8, false);
  // Between 13 and 15 sixteenths of one, and the same of the power that is no double any more.
  const Positions x = mesh.x_t0.array() / (16 * mesh.x_t0.cwiseAbs().maxCoeff()) + .875;
  const Positions huge = x * 0x1p512 * 0x1p512;
  ASSERT_GE(huge.cwiseAbs().maxCoeff(), .5 * std::numeric_limits<double>::max());
  ASSERT_TRUE(huge.allFinite());
  const BoundingVolumeTree small(mesh.topology, x), large(mesh.topology, huge);
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.topology.triangles.size()); ++t)
    EXPECT_EQ(small.leaf_of(t), large.leaf_of(t));
}

}  // namespace
}  // namespace assay::tests
