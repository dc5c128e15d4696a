#include "detector/parallel/workers.h"

#include "detector/detector.h"
#include "detector/mesh/for_all.h"
#include "detector/state/step_state.h"
#include "tests/detector/search/search_meshes.h"
#include "tests/detector/traditional/patch_meshes.h"

namespace assay::detector {
namespace {

TEST(Workers, CoverEachItemOnceInLanesBelowTheirCount) {
  for (const std::uint32_t threads : {1u, 2u, 3u, 8u}) {
    const Workers workers(threads);
    EXPECT_TRUE(workers.count() == threads || workers.is_alone());
    for (const std::size_t count : {0, 1, 7, 8, 9, 1000}) {
      std::vector<std::atomic<int>> visits(count);
      workers.share_out(count, 8, [&](const LoopPiece& piece) {
        EXPECT_LT(piece.lane, workers.count());
        EXPECT_LE(piece.end - piece.begin, 8u);
        for (std::size_t i = piece.begin; i < piece.end; ++i) ++visits[i];
      });
      for (const auto& times : visits) EXPECT_EQ(times, 1) << threads << " threads, " << count;
    }
  }
}

TEST(Workers, NoTwoPiecesRunInOneLaneAtOnce) {
  const Workers workers(4);
  std::vector<std::atomic<bool>> busy(workers.count());
  workers.share_out(2000, 1, [&](const LoopPiece& piece) {
    EXPECT_FALSE(busy[piece.lane].exchange(true));
    busy[piece.lane] = false;
  });
}

TEST(Workers, ThrowAgainWhatABodyThrows) {
  const Workers workers(3);
  const auto body = [](const LoopPiece& piece) {
    if (piece.begin == 50) throw std::runtime_error("fifty");
  };
  EXPECT_THROW(workers.share_out(100, 1, body), std::runtime_error);
  std::atomic<int> after = 0;
  workers.share_out(100, 1, [&](const LoopPiece&) { ++after; });
  EXPECT_EQ(after, 100);
}

TEST(Workers, ZeroIsAllThatTheMachineHas) { EXPECT_GE(Workers(0).count(), 1u); }

TEST(SharedStop, IsAskedByTheCallerAloneAndHeardByAll) {
  const auto caller = std::this_thread::get_id();
  int calls = 0;
  const StopFunction stop = [&] {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    return ++calls > 3;
  };
  SharedStop shared(stop);
  const StopFunction heard = shared.function();
  const auto in_another_thread = [&] {
    bool says = false;
    std::thread([&] { says = heard(); }).join();
    return says;
  };
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(heard());
  EXPECT_FALSE(in_another_thread());
  EXPECT_TRUE(heard());
  EXPECT_TRUE(in_another_thread());
  EXPECT_TRUE(heard());
  EXPECT_EQ(calls, 4);
  const StopFunction none;
  EXPECT_FALSE(SharedStop(none).function());
}

TEST(ForAll, SumsAreThoseOfOneThread) {
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    const Workers workers(threads);
    PacedStop pace(never_stops, workers);
    const auto add = [](std::uint64_t& sum, std::size_t i) { sum += i; };
    const auto join = [](std::uint64_t& sum, std::uint64_t other) { sum += other; };
    const std::uint64_t count = 100'000;
    EXPECT_EQ(sum_over_all(count, 1, &pace, std::uint64_t{0}, add, join), count * (count - 1) / 2);
  }
}

TEST(ForAll, EndsSoonAfterTheStop) {
  for (const std::uint32_t threads : {1u, 3u}) {
    const Workers workers(threads);
    std::atomic<std::size_t> done = 0;
    const StopFunction stop = [&] { return true; };
    SharedStop shared(stop);
    const StopFunction heard = shared.function();
    PacedStop pace(heard, workers);
    const std::size_t count = 100'000'000;
    EXPECT_FALSE(
        for_all_paced(count, PacedStop::usual_interval, pace, [&](std::size_t) { ++done; }));
    EXPECT_LT(done, count);
  }
}

// A step of several threads gives what a step of one thread gives, on a mesh that every loop shares
// out. This is what ThreadSanitizer looks at; meshes of every kind are in tests/properties.
class ThreadsInSearch : public testing::TestWithParam<Culling> {};

TEST_P(ThreadsInSearch, DoNotShow) {
  // 9,000 triangles, two sheets that pass through each other.
  const auto mesh = tests::SearchMeshes(11).sheets(2, 48, false);
  const Triangles triangles = mesh.rows();
  const Positions middle = .98 * mesh.x_t0 + .02 * mesh.x_t1,
                  end = .96 * mesh.x_t0 + .04 * mesh.x_t1;
  const auto detector_of = [&](std::uint32_t threads) {
    const Options options{.culling = GetParam(), .threads = threads};
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
    EXPECT_EQ(shared.state(), alone.state());
  }
}

INSTANTIATE_TEST_SUITE_P(Cullings, ThreadsInSearch,
                         testing::Values(Culling::automatic, Culling::bvh, Culling::normal_cone));

TEST(ThreadsInStep, FreeStepsAndViewSets) {
  const tests::Sheet ball = tests::sphere(50, 1);  // 9,800 triangles
  Positions dented = ball.x;
  dented.topRows(200) *= .7;
  for (const auto culling : {Culling::view_point, Culling::view_line, Culling::automatic}) {
    auto alone = Detector::create(ball.rows, ball.x, {culling}).value(),
         shared = Detector::create(ball.rows, ball.x, {.culling = culling, .threads = 3}).value();
    const Positions larger = 1.5 * ball.x;
    for (const auto& [x_t0, x_t1] : {std::pair(ball.x, larger), std::pair(larger, ball.x),
                                     std::pair(ball.x, dented), std::pair(dented, ball.x)}) {
      const auto expected = alone.step(x_t0, x_t1), result = shared.step(x_t0, x_t1);
      tests::expect_same_work(result, expected);
      EXPECT_EQ(result.view_positive, expected.view_positive);
    }
    EXPECT_EQ(shared.state(), alone.state());
  }
}

}  // namespace
}  // namespace assay::detector
