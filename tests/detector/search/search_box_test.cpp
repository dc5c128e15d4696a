// A single box against the tree.
#include <gtest/gtest.h>

#include "detector/search/pair_search.h"
#include "tests/detector/search/search_meshes.h"

namespace assay::tests {
namespace {

using detector::BoundingVolumeTree;
using detector::SearchCounts;

TEST(SearchBox, FindsWhatIsNotApartAndStopsWhenTold) {
  SearchMeshes meshes(5);
  for (int i = 0; i < 20; ++i) {
    const MovingMesh mesh = meshes.sheets(3, 4, i % 2 == 0);
    BoundingVolumeTree tree(mesh.topology, mesh.x_t0);
    tree.refit(mesh.topology, {mesh.x_t0, mesh.x_t1});
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

}  // namespace
}  // namespace assay::tests
