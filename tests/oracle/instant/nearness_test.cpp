#include "oracle/instant/nearness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/oracle/embedding.h"
#include "tests/oracle/small_meshes.h"

namespace assay::oracle {
namespace {

using test::positions;
using test::triangles;

const WantedPair all = [](std::int32_t, std::int32_t) { return true; };

// Two triangles, one above the other at this height, and moved along x.
detector::Positions above(double height, double aside = 0) {
  return positions({{0, 0, 0},
                    {4, 0, 0},
                    {0, 4, 0},
                    {aside + 1, 1, height},
                    {aside + 2, 1, height},
                    {aside + 1, 2, height}});
}
const detector::Triangles two = triangles({{0, 1, 2}, {3, 4, 5}});

TEST(Nearness, IsExactAtTheDistanceItself) {
  for (const double height : {0.5, 1e-300, 3e5, 0.1}) {
    EXPECT_FALSE(any_nearer_than(above(height), two, height, all)) << height;
    EXPECT_TRUE(any_nearer_than(above(height), two, std::nextafter(height, 1e9), all)) << height;
  }
}

TEST(Nearness, OfDistanceNoneIsContact) {
  EXPECT_FALSE(any_nearer_than(above(1e-300), two, 0, all));
  EXPECT_TRUE(any_nearer_than(above(0), two, 0, all));
}

TEST(Nearness, AsksOnlyThePairsThatCount) {
  EXPECT_FALSE(any_nearer_than(above(0), two, 1, [](std::int32_t, std::int32_t) { return false; }));
}

TEST(Nearness, OfEdgesAndOfFeaturesThatHaveShrunk) {
  // Edges that cross at a distance of 3, and no vertex is nearer to a face.
  const auto crossed =
      positions({{-9, 0, 0}, {9, 0, 0}, {0, 0, -9}, {0, -9, 3}, {0, 9, 3}, {0, 0, 12}});
  EXPECT_FALSE(any_nearer_than(crossed, two, 3, all));
  EXPECT_TRUE(any_nearer_than(crossed, two, 3.0001, all));
  // A triangle that is a point, and one that is a segment: 3-4-5.
  const auto shrunk =
      positions({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {3, 4, -1}, {3, 4, 1}, {3, 4, 0.5}});
  EXPECT_FALSE(any_nearer_than(shrunk, two, 5, all));
  EXPECT_TRUE(any_nearer_than(shrunk, two, 5.0001, all));
}

// Neighbours meet in what they share, which is no nearness.
TEST(Nearness, IgnoresWhatSharesAVertex) {
  const auto fan = positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}});
  EXPECT_FALSE(any_nearer_than(fan, triangles({{0, 1, 2}, {0, 3, 4}}), 0.5, all));
}

TEST(Nearness, AgreesWithEmbeddingOnRandomMeshes) {
  std::mt19937_64 engine(7);
  int met = 0;
  for (int i = 0; i < 200; ++i) {
    detector::Positions x(9, 3);
    for (Eigen::Index k = 0; k < x.size(); ++k) x.data()[k] = static_cast<double>(engine() % 7);
    const auto f = triangles({{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {2, 3, 6}});
    const bool meets = any_nearer_than(x, f, 0, all).has_value();
    EXPECT_EQ(meets, !embedded(x, f)) << "i = " << i;
    met += meets ? 1 : 0;
  }
  EXPECT_GT(met, 50);
  EXPECT_LT(met, 195);
}

}  // namespace
}  // namespace assay::oracle
