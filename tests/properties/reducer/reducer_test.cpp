// The reducer as a whole, on faults planted in toy detectors.
#include "properties/reducer/reducer.h"

#include <fmt/format.h>

#include "corpus/scenes/shapes.h"
#include "oracle/mesh/mesh_features.h"
#include "properties/reducer/case_edits.h"
#include "tests/properties/reducer/toy_faults.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

using toys::large_failing_case, toys::toy_fault;

class ReducesToKnownSize : public testing::TestWithParam<std::size_t> {};

TEST_P(ReducesToKnownSize, FromALargeMeshAndSeveralSteps) {
  const auto& fault = toys::toy_faults()[GetParam()];
  SCOPED_TRACE(fault.name);
  const auto start = large_failing_case(fault, 120, 4, 1);
  const auto before = size_of(start);
  ASSERT_GE(before.triangles, 80u);
  ASSERT_EQ(before.steps, 4u);
  const auto wanted = fault.judge(start);
  ASSERT_TRUE(wanted);

  // reducer_table prints what is reached from 200 triangles and 8 steps, without this limit.
  const Reduction reduction = reduce(start, fault.judge, {60, 8000});
  fmt::print("{}: {}, {} calls, {:.2f} s\n", fault.name, size_text(start, reduction.smallest),
             reduction.calls, reduction.seconds);
  EXPECT_LE(size_of(reduction.smallest).vertices, fault.vertices + 1);
  EXPECT_TRUE(is_valid(reduction.smallest));
  const auto found = fault.judge(reduction.smallest);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->signature, wanted->signature);
  EXPECT_EQ(reduction.finding.signature, wanted->signature);
  EXPECT_EQ(reduction.smallest.options, start.options);
}

INSTANTIATE_TEST_SUITE_P(ToyFaults, ReducesToKnownSize,
                         testing::Range<std::size_t>(0, toys::toy_faults().size()));

TEST(Reducer, AFaultOfClosedMeshesEndsInATetrahedronOfSmallIntegers) {
  const auto& fault = toy_fault("(V0,V0) dropped");
  const auto start = large_failing_case(fault, 200, 8, 5);
  const auto small = reduce(start, fault.judge, {}).smallest;
  EXPECT_EQ(small.triangles.rows(), 4);
  EXPECT_EQ(small.frames.front().rows(), 4);
  EXPECT_EQ(corpus::steps_of(small).size(), 1u);
  EXPECT_TRUE(oracle::unmatched_edges(small.triangles).empty()) << "it is closed";
  for (const auto& frame : small.frames)
    for (const double x : frame.reshaped())
      EXPECT_TRUE(std::abs(x) <= 9 && x == std::floor(x)) << x;
  EXPECT_EQ(small.triangles.row(0), Eigen::RowVector3i(0, 1, 2)) << "numbered by use";
}

TEST(Reducer, SameInputSameBytes) {
  const auto& fault = toy_fault("no closure");
  const auto start = large_failing_case(fault, 120, 3, 2);
  const auto once = reduce(start, fault.judge, {600, 2000});
  const auto again = reduce(start, fault.judge, {600, 2000});
  EXPECT_EQ(corpus::case_text(once.smallest), corpus::case_text(again.smallest));
  EXPECT_EQ(once.calls, again.calls);
}

// And hears of each smaller case; the last is the result.
TEST(Reducer, EverythingJudgedIsValidAndJudgedOnce) {
  const auto& fault = toy_fault("(V+,V0) dropped");
  const auto start = large_failing_case(fault, 120, 3, 3);
  std::set<std::string> seen;
  const Judge watched = [&](const corpus::Case& c) {
    EXPECT_TRUE(is_valid(c));
    EXPECT_TRUE(seen.insert(corpus::case_text(c)).second);
    return fault.judge(c);
  };
  MeshSize last = size_of(start);
  const auto wanted = fault.judge(start)->signature;
  int heard = 0;
  const auto reduction = reduce(start, watched, {}, [&](const corpus::Case& better) {
    EXPECT_LT(size_of(better), std::exchange(last, size_of(better)));
    EXPECT_EQ(fault.judge(better)->signature, wanted);
    ++heard;
  });
  EXPECT_GT(heard, 3);
  EXPECT_EQ(size_of(reduction.smallest), last);
  EXPECT_EQ(reduction.calls, seen.size());
  std::uint64_t tried = 0, accepted = 0;
  for (const auto& pass : reduction.passes) {
    tried += pass.tries;
    accepted += pass.accepted;
  }
  EXPECT_EQ(tried, reduction.calls);
  EXPECT_GT(accepted, 0u);
}

// A case that holds is returned as it is, and so is one for which there is no time.
TEST(Reducer, LimitsAreKeptAndTheBestSoFarIsReturned) {
  const auto& fault = toy_fault("no closure");
  const auto start = large_failing_case(fault, 120, 3, 2);
  std::uint64_t calls = 0;
  const Judge counted = [&](const corpus::Case& c) {
    ++calls;
    return fault.judge(c);
  };
  const auto few = reduce(start, counted, {600, 60});
  EXPECT_EQ(calls, 60u);
  EXPECT_LT(size_of(few.smallest), size_of(start));
  EXPECT_TRUE(fault.judge(few.smallest));
  const auto no_time = reduce(start, fault.judge, {0, 100000});
  EXPECT_EQ(no_time.calls, 1u);
  const auto holds =
      reduce(start, [](const corpus::Case&) { return std::optional<Finding>(); }, {});
  EXPECT_TRUE(holds.finding.signature.empty());
  for (const auto* unchanged : {&no_time, &holds})
    EXPECT_EQ(size_of(unchanged->smallest), size_of(start));
  for (const auto* reduction : {&few, &no_time, &holds}) EXPECT_FALSE(reduction->fixed_point);
}

TEST(Reducer, TheDetectorsOwnViewIsWrittenDownAndDroppedAtTheEnd) {
  const auto& fault = toy_fault("(V+,V-) dropped");
  auto start = large_failing_case(fault, 120, 2, 1);
  start.view.reset();  // the toy looks from the origin by itself
  std::uint64_t with_view = 0;
  const Judge watched = [&](const corpus::Case& c) {
    with_view += c.view ? 1 : 0;
    return fault.judge(c);
  };
  const auto reduction = reduce(start, watched, {}, {}, [](const corpus::Case& c) {
    auto result = c;
    result.view = corpus::CaseView{std::vector<detector::Point>(c.frames.size(), {0, 0, 0}), {}};
    return std::optional(result);
  });
  EXPECT_GT(with_view, 10u);
  EXPECT_EQ(reduction.smallest.frames.front().rows(), 4);
  EXPECT_FALSE(reduction.smallest.view);
  EXPECT_TRUE(reduction.fixed_point);
}

// Meshes of very many triangles: what a small part shows is cut down to it, and what only size
// shows is told as the least number of triangles that does.

// A sheet of about so many triangles that does not move.
corpus::Case sheet(int triangles) {
  const auto mesh = corpus::sheet_shape(triangles);
  corpus::Case c;
  c.triangles = mesh.triangles;
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
    if (distance >= most) continue;
    most = distance;
    nearest = static_cast<std::int32_t>(t);
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

// Fails with more triangles than so many.
Judge judge_of_size(Eigen::Index most) {
  return [=](const corpus::Case& x) -> std::optional<Finding> {
    if (x.triangles.rows() <= most) return std::nullopt;
    return Finding{"free-sound: answered free, large mesh", {0, 1}};
  };
}

TEST(LargeMeshes, WhatOnlySizeShowsIsToldAsTheLeastNumberOfTriangles) {
  const auto c = sheet(100'000);
  for (const Eigen::Index most : {5000, 50'000}) {
    const auto reduction = reduce(c, judge_of_size(most), {600, 200});
    EXPECT_EQ(reduction.smallest.triangles.rows(), most + 1);
    EXPECT_EQ(reduction.fails_from, static_cast<std::size_t>(most + 1));
    EXPECT_TRUE(reduction.fixed_point);
    EXPECT_LT(reduction.calls, 40u);
  }
  EXPECT_EQ(fails_from_text(5001), "fails from 5001 triangles on");
  // A limit that ends the search leaves the number unsaid, because a smaller one might fail.
  const auto reduction = reduce(sheet(20'000), judge_of_size(5000), {600, 8});
  EXPECT_EQ(reduction.fails_from, 0u);
  EXPECT_FALSE(reduction.fixed_point);
  EXPECT_LT(reduction.smallest.triangles.rows(), 20'000);
}

}  // namespace
}  // namespace assay::properties
