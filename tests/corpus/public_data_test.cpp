// Reads the public data sets in the folder that ASSAY_DATA names; skipped if there is no such
// folder.
#include "tests/public_data.h"

#include "corpus/formats/sequences.h"
#include "corpus/queries/query_csv.h"
#include "tests/test.h"

namespace assay::corpus {
namespace {

class PublicData : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::public_data()) GTEST_SKIP() << "no public data";
    folder_ = tests::public_data();
  }

  // A data set may be missing from the folder.
  std::filesystem::path at(const char* place) const { return folder_ / place; }

 private:
  std::filesystem::path folder_;
};

TEST_F(PublicData, RodTwistFrames) {
  const std::filesystem::path paths[] = {at("scalable-ccd/rod-twist/frames/3036.ply"),
                                         at("scalable-ccd/rod-twist/frames/3037.ply")};
  if (!exists(paths[0])) GTEST_SKIP() << paths[0] << " is absent";
  const auto sequence = read_sequence(paths);
  ASSERT_TRUE(sequence) << sequence.error().message;
  EXPECT_EQ(sequence.value().frames[1].rows(), 39940);
  EXPECT_EQ(sequence.value().triangles.rows(), 79864);
}

TEST_F(PublicData, RodTwistQueries) {
  const auto folder = at("scalable-ccd/rod-twist");
  if (!exists(folder)) GTEST_SKIP() << folder << " is absent";
  const auto edges =
      read_queries(folder / "queries/3036ee.csv", folder / "mma_bool/3036ee_mma_bool.json");
  ASSERT_TRUE(edges) << edges.error().message;
  EXPECT_EQ(edges.value().size(), 4370U);
  const auto faces =
      read_queries(folder / "queries/3036vf.csv", folder / "mma_bool/3036vf_mma_bool.json");
  ASSERT_TRUE(faces) << faces.error().message;
  EXPECT_EQ(faces.value().size(), 801U);
  EXPECT_TRUE(faces.value()[0].truth.has_value());
}

TEST_F(PublicData, SampleQueries) {
  const auto folder = at("sample-queries");
  if (!exists(folder)) GTEST_SKIP() << folder << " is absent";
  std::size_t files = 0, count = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder)) {
    if (file.path().extension() != ".csv") continue;
    const auto queries = read_queries(file.path());
    ASSERT_TRUE(queries) << queries.error().message;
    EXPECT_TRUE(queries.value()[0].truth.has_value());
    count += queries.value().size();
    ++files;
  }
  EXPECT_GT(files, 0U);
  EXPECT_GE(count, 20 * files);
}

TEST_F(PublicData, CompressedDancer) {
  const auto folder = at("codim-ipc-kick");
  if (!exists(folder)) GTEST_SKIP() << folder << " is absent";
  std::vector<std::filesystem::path> paths;
  for (int i = 56; i <= 62; ++i)
    paths.push_back(folder / ("shell" + std::to_string(i) + ".obj.gz"));
  const auto sequence = read_sequence(paths);
  ASSERT_TRUE(sequence) << sequence.error().message;
  EXPECT_EQ(sequence.value().frames.size(), 7U);
  EXPECT_EQ(sequence.value().frames[6].rows(), 12811);
  EXPECT_EQ(sequence.value().triangles.rows(), 25472);
}

TEST_F(PublicData, ToolkitMeshes) {
  const auto folder = at("ipc-toolkit");
  if (!exists(folder)) GTEST_SKIP() << folder << " is absent";
  const auto bunny = read_mesh(folder / "bunny.ply");
  ASSERT_TRUE(bunny) << bunny.error().message;
  EXPECT_EQ(bunny.value().triangles.rows(), 5002);
}

}  // namespace
}  // namespace assay::corpus
