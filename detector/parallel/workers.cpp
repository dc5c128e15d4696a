#include "detector/parallel/workers.h"

#include <algorithm>
#include <utility>

#include "detector/parallel/processor_state.h"

namespace assay::detector {
namespace {

// oneTBB orders what happens before, in and after a piece. It is not compiled for ThreadSanitizer,
// so that has to be told of this order. It is not told of any order among pieces, so it still
// finds what two of them do to the same place.
#ifdef __SANITIZE_THREAD__
std::atomic<unsigned> loops_begun = 0, pieces_done = 0;
void begins_loop() { loops_begun.fetch_add(1, std::memory_order_release); }
void begins_piece() { loops_begun.load(std::memory_order_acquire); }
void ends_piece() { pieces_done.fetch_add(1, std::memory_order_release); }
void ends_loop() { pieces_done.load(std::memory_order_acquire); }
#else
void begins_loop() {}
void begins_piece() {}
void ends_piece() {}
void ends_loop() {}
#endif

// Calls the function at the end of a scope, also if a body throws.
class AtEnd {
 public:
  explicit AtEnd(void (*call)()) : call_(call) {}
  ~AtEnd() { call_(); }
  AtEnd(const AtEnd&) = delete;
  AtEnd& operator=(const AtEnd&) = delete;

 private:
  void (*call_)();
};

// The pieces of one loop.
class Pieces : public ThreadArena::Work {
 public:
  Pieces(std::size_t count, std::size_t most, const std::function<void(const LoopPiece&)>& body)
      : count_(count), most_(most), body_(body) {}
  void run(std::size_t i, std::size_t lane) const override {
    begins_piece();
    const AtEnd end(ends_piece);
    const ProcessorState state;
    body_({i * most_, std::min((i + 1) * most_, count_), lane});
  }

 private:
  const std::size_t count_, most_;
  const std::function<void(const LoopPiece&)>& body_;
};

}  // namespace

Workers::Workers(std::uint32_t threads) {
  constexpr std::uint32_t most_threads = 1024;
  const std::uint32_t wanted = threads != 0 ? threads : std::thread::hardware_concurrency();
  const std::size_t count = std::clamp(wanted, 1u, most_threads);
  if (count > 1) arena_ = ThreadArena::make(count);
  if (arena_) count_ = count;
}

Workers::Workers(std::unique_ptr<ThreadArena> arena, std::size_t lanes)
    : count_(lanes), arena_(std::move(arena)) {}

void Workers::share_out(std::size_t count, std::size_t most,
                        const std::function<void(const LoopPiece&)>& body) const {
  if (!arena_ || count <= most) {
    for (std::size_t begin = 0; begin < count; begin += most)
      body({begin, std::min(begin + most, count), 0});
    return;
  }
  const Pieces pieces(count, most, body);
  begins_loop();
  const AtEnd end(ends_loop);
  arena_->run((count + most - 1) / most, pieces);
}

}  // namespace assay::detector
