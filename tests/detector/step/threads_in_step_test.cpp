// A step of several threads gives what a step of one thread gives, on a mesh that every loop shares
// out. This is what ThreadSanitizer looks at; meshes of every kind are in tests/properties.
#include "detector/detector.h"
#include "detector/state/step_state.h"
#include "tests/detector/search/search_meshes.h"

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
      tests::expect_same_contacts(result, expected[s]);
      EXPECT_EQ(result.signs, expected[s].signs);
      EXPECT_EQ(result.doubts, expected[s].doubts);
      EXPECT_EQ(result.counts.search.box_tests, expected[s].counts.search.box_tests);
      EXPECT_EQ(result.counts.search.candidate_pairs, expected[s].counts.search.candidate_pairs);
      EXPECT_EQ(result.counts.narrow.rungs.total(), expected[s].counts.narrow.rungs.total());
    }
    EXPECT_EQ(shared.state().bytes(), alone.state().bytes());
  }
}

INSTANTIATE_TEST_SUITE_P(Cullings, ThreadsInSearch,
                         testing::Values(Culling::automatic, Culling::bvh, Culling::normal_cone));

// Rings of vertices between two poles.
struct Ball {
  static constexpr int rings = 60, around = 80;
  Triangles triangles = Triangles(2 * rings * around, 3);
  Positions x = Positions(rings * around + 2, 3);

  Ball() {
    const int last = rings * around + 1;
    x.row(0) << 0, 0, 1;
    x.row(last) << 0, 0, -1;
    Eigen::Index row = 0;
    for (int i = 0; i < rings; ++i) {
      for (int j = 0; j < around; ++j) {
        const int next = (j + 1) % around, a = 1 + i * around + j, b = 1 + i * around + next;
        const double polar = M_PI * (i + 1) / (rings + 1), turn = 2 * M_PI * j / around;
        x.row(a) << std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
            std::cos(polar);
        if (i == 0) triangles.row(row++) << 0, a, b;
        if (i + 1 == rings) {
          triangles.row(row++) << a, last, b;
        } else {
          triangles.row(row++) << a, a + around, b + around;
          triangles.row(row++) << a, b + around, b;
        }
      }
    }
  }
};

TEST(ThreadsInStep, FreeStepsAndViewSets) {
  const Ball ball;
  Positions dented = ball.x;
  dented.topRows(200) *= .7;
  for (const auto culling : {Culling::view_point, Culling::view_line, Culling::automatic}) {
    Options options{culling}, with_threads{culling};
    with_threads.threads = 3;
    auto alone = std::move(Detector::create(ball.triangles, ball.x, options).value()),
         shared = std::move(Detector::create(ball.triangles, ball.x, with_threads).value());
    const Positions larger = 1.5 * ball.x;
    for (const auto& [x_t0, x_t1] : {std::pair(ball.x, larger), std::pair(larger, ball.x),
                                     std::pair(ball.x, dented), std::pair(dented, ball.x)}) {
      const auto expected = alone.step(x_t0, x_t1), result = shared.step(x_t0, x_t1);
      tests::expect_same_contacts(expected, result);
      EXPECT_EQ(expected.signs, result.signs);
      EXPECT_EQ(expected.view_positive, result.view_positive);
    }
    EXPECT_EQ(shared.state().bytes(), alone.state().bytes());
  }
}

}  // namespace
}  // namespace assay::detector
