#include "detector/parallel/workers.h"

#include "detector/mesh/for_all.h"
#include "tests/test.h"

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

}  // namespace
}  // namespace assay::detector
