// A step of several threads gives what a step of one thread gives, on a mesh that every loop shares
// out. This is what ThreadSanitizer looks at; meshes of every kind are in tests/properties.
#include "detector/detector.h"
#include "detector/state/step_state.h"
#include "tests/detector/search/search_meshes.h"
#include "tests/detector/traditional/patch_meshes.h"

namespace assay::detector {
namespace {

class ThreadsInSearch : public testing::TestWithParam<Culling> {};

TEST_P(ThreadsInSearch, DoNotShow) {
  // 9,000 triangles, two sheets that pass through each other.
  const auto mesh = tests::SearchMeshes(11).sheets(2, 48, false);
  const Triangles triangles = mesh.rows();
  const Positions middle = .98 * mesh.x_t0 + .02 * mesh.x_t1,
                  end = .96 * mesh.x_t0 + .04 * mesh.x_t1;
  const auto detector_of = [&](std::uint32_t threads) {
    Options options{GetParam()};
    options.threads = threads;
    return std::move(Detector::create(triangles, mesh.x_t0, options).value());
  };
  auto alone = detector_of(1);
  const std::vector<StepResult> expected = {alone.step(mesh.x_t0, middle), alone.step(middle, end)};
  EXPECT_FALSE(expected[0].pairs.empty() && expected[1].pairs.empty());
  for (const std::uint32_t threads : {2u, 3u}) {
    auto shared = detector_of(threads);
    for (std::size_t s = 0; s < 2; ++s) {
      const auto result = s == 0 ? shared.step(mesh.x_t0, middle) : shared.step(middle, end);
      tests::expect_same_work(result, expected[s]);
      EXPECT_EQ(result.counts.narrow.rungs.total(), expected[s].counts.narrow.rungs.total());
    }
    EXPECT_EQ(shared.state().bytes(), alone.state().bytes());
  }
}

INSTANTIATE_TEST_SUITE_P(Cullings, ThreadsInSearch,
                         testing::Values(Culling::automatic, Culling::bvh, Culling::normal_cone));

TEST(ThreadsInStep, FreeStepsAndViewSets) {
  const tests::Sheet ball = tests::sphere_sheet(49, 1);  // 9,604 triangles
  Positions dented = ball.x;
  dented.topRows(200) *= .7;
  for (const auto culling : {Culling::view_point, Culling::view_line, Culling::automatic}) {
    Options options{culling}, with_threads{culling};
    with_threads.threads = 3;
    auto alone = Detector::create(ball.rows, ball.x, options).value(),
         shared = Detector::create(ball.rows, ball.x, with_threads).value();
    const Positions larger = 1.5 * ball.x;
    for (const auto& [x_t0, x_t1] : {std::pair(ball.x, larger), std::pair(larger, ball.x),
                                     std::pair(ball.x, dented), std::pair(dented, ball.x)}) {
      const auto expected = alone.step(x_t0, x_t1), result = shared.step(x_t0, x_t1);
      tests::expect_same_work(result, expected);
      EXPECT_EQ(result.view_positive, expected.view_positive);
    }
    EXPECT_EQ(shared.state().bytes(), alone.state().bytes());
  }
}

}  // namespace
}  // namespace assay::detector
