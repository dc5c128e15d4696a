// Meshes of very many triangles: what a small part shows is cut down to it, and what only size
// shows is told as the least number of triangles that does.
#include <algorithm>

#include "corpus/scenes/shapes.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/reducer.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

// A sheet of about so many triangles that does not move.
corpus::Case sheet(int triangles) {
  auto mesh = corpus::sheet_shape(triangles);
  corpus::Case c;
  c.triangles = std::move(mesh.triangles);
  c.frames.assign(2, mesh.positions);
  return c;
}

// The triangle whose middle is nearest to a place, if it is near enough to be the one looked for.
std::optional<std::int32_t> triangle_at(const corpus::Case& c, double x, double y, double most) {
  std::optional<std::int32_t> nearest;
  for (Eigen::Index t = 0; t < c.triangles.rows(); ++t) {
    Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) middle += c.frames[0].row(c.triangles(t, k)) / 3;
    const double distance = std::max(std::abs(middle[0] - x), std::abs(middle[1] - y));
    if (distance < most) {
      most = distance;
      nearest = static_cast<std::int32_t>(t);
    }
  }
  return nearest;
}

TEST(LargeMeshes, WhatTwoTrianglesShowIsCutDownToThem) {
  const auto c = sheet(100'000);
  const double cell = 2 / std::sqrt(static_cast<double>(c.triangles.rows()) / 2);
  std::uint64_t judged = 0;
  const Judge judge = [&](const corpus::Case& x) -> std::optional<Finding> {
    judged += static_cast<std::uint64_t>(x.triangles.rows());
    const auto one = triangle_at(x, 0.3, 0.3, cell), other = triangle_at(x, 0.31, 0.3, cell);
    if (!one || !other || *one == *other) return std::nullopt;
    // The cause is another one in a small mesh.
    return Finding{x.triangles.rows() > 500 ? "total: error, large" : "total: error, small",
                   {*one, *other}};
  };
  const auto reduction = reduce(c, judge, {600, 400});
  EXPECT_LE(reduction.smallest.triangles.rows(), 12);
  EXPECT_EQ(reduction.fails_from, 0u);
  // The whole mesh is looked at once; all other cases are small ones.
  EXPECT_LT(judged, static_cast<std::uint64_t>(2 * c.triangles.rows()));
}

TEST(LargeMeshes, WhatOnlySizeShowsIsToldAsTheLeastNumberOfTriangles) {
  const auto c = sheet(100'000);
  for (const Eigen::Index most : {5000, 50'000}) {
    const Judge judge = [&](const corpus::Case& x) -> std::optional<Finding> {
      if (x.triangles.rows() <= most) return std::nullopt;
      return Finding{"free-sound: answered free, large mesh", {0, 1}};
    };
    const auto reduction = reduce(c, judge, {600, 200});
    EXPECT_EQ(reduction.smallest.triangles.rows(), most + 1);
    EXPECT_EQ(reduction.fails_from, static_cast<std::size_t>(most + 1));
    EXPECT_TRUE(reduction.fixed_point);
    EXPECT_LT(reduction.calls, 40u);
  }
  EXPECT_EQ(fails_from_text(5001), "fails from 5001 triangles on");
}

// A limit that ends the search leaves the number unsaid, because a smaller one might fail.
TEST(LargeMeshes, ALimitLeavesTheNumberUnsaid) {
  const Judge judge = [&](const corpus::Case& x) -> std::optional<Finding> {
    if (x.triangles.rows() <= 5000) return std::nullopt;
    return Finding{"free-sound: answered free", {0, 1}};
  };
  const auto reduction = reduce(sheet(20'000), judge, {600, 8});
  EXPECT_EQ(reduction.fails_from, 0u);
  EXPECT_FALSE(reduction.fixed_point);
  EXPECT_LT(reduction.smallest.triangles.rows(), 20'000);
}

}  // namespace
}  // namespace assay::properties
