#include "detector/traditional/moving_contour.h"
#include "tests/detector/view/revolved.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

Topology band(int around, int rows) {
  Triangles triangles(2 * around * rows, 3);
  Eigen::Index row = 0;
  const auto at = [&](int i, int j) { return i * around + j % around; };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < around; ++j) {
      triangles.row(row++) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      triangles.row(row++) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  }
  return make_topology(triangles, around * (rows + 1));
}

TEST(SamplePatches, AreOfThreeSizesAndSpreadOverTheMesh) {
  const Topology mesh = band(128, 64);  // 16,384 triangles
  ContourMaker maker(mesh);
  const SamplePatches samples = sample_patches(mesh, maker);
  EXPECT_EQ(samples.small.size(), 32u);
  EXPECT_EQ(samples.medium.size(), 16u);
  EXPECT_EQ(samples.large.size(), 8u);
  for (const auto& [patches, size] :
       {std::pair(&samples.small, 12u), {&samples.medium, 36u}, {&samples.large, 96u}}) {
    std::set<std::int32_t> first_of;
    for (const auto& patch : *patches) {
      EXPECT_EQ(patch.triangles.size(), size);
      EXPECT_EQ(std::set(patch.triangles.begin(), patch.triangles.end()).size(), size);
      EXPECT_FALSE(patch.contour.empty());
      EXPECT_LE(patch.contour.size(), size + 2) << "a disk of n triangles has n + 2 at most";
      first_of.insert(patch.triangles[0] * 8 / 16'384);
    }
    EXPECT_EQ(first_of.size(), 8u) << "in each eighth of the mesh";
  }
}

TEST(SamplePatches, EndWithTheirComponentAndMayHaveNoContour) {
  const Topology tetrahedron =
      make_topology((Triangles(4, 3) << 0, 1, 2, 0, 3, 1, 1, 3, 2, 0, 2, 3).finished(), 4);
  ContourMaker maker(tetrahedron);
  const SamplePatches samples = sample_patches(tetrahedron, maker);
  EXPECT_EQ(samples.small.size(), 4u);
  ASSERT_EQ(samples.large.size(), 1u);
  EXPECT_EQ(samples.large[0].triangles.size(), 4u);
  EXPECT_TRUE(samples.large[0].contour.empty()) << "a closed surface has no boundary";
}

}  // namespace
}  // namespace assay::detector
