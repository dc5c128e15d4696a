#include "detector/parallel/workers.h"

#include <algorithm>
#include <utility>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace assay::detector {
namespace {

using State = ProcessorState::State;

#if defined(__SSE2__)
// MXCSR as a program starts with it: nothing traps, and all else is 0. The lowest six bits are
// flags of the exceptions that arithmetic has met.
constexpr State needed = 0x1F80, flags = 0x3F;

State state_now() { return _mm_getcsr(); }
bool is_needed(State state) { return (state & ~flags) == needed; }
void put(State state) { _mm_setcsr(state); }
void put_needed() {
  if (!is_needed(state_now())) put(needed);
}
#else
// Returns the environment as a program starts with it. On ARM it also holds the treatment of
// denormals.
State state_now() {
  State state;
  std::fegetenv(&state);
  return state;
}
bool is_needed(const State&) { return false; }
void put(const State& state) { std::fesetenv(&state); }
void put_needed() { std::fesetenv(FE_DFL_ENV); }
#endif

// oneTBB orders what happens before, in and after a piece. It is not compiled for ThreadSanitizer,
// which therefore has to be told of this order. ThreadSanitizer is not told of any order among
// pieces, so it still finds two pieces that use the same place.
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

ProcessorState::ProcessorState() : callers_(state_now()) {
  if (!is_needed(callers_)) put_needed();
}

ProcessorState::~ProcessorState() {
  if (!is_needed(callers_)) put(callers_);
}

std::function<bool()> ProcessorState::in_callers_state(
    const std::function<bool()>& function) const {
  if (!function) return {};
  return [this, &function] {
    if (!is_needed(callers_)) put(callers_);
    const AtEnd end(put_needed);
    return function();
  };
}

Workers::Workers(std::uint32_t threads) {
  constexpr std::uint32_t most_threads = 1024;
  const std::uint32_t request = threads != 0 ? threads : std::thread::hardware_concurrency();
  const std::size_t count = std::clamp(request, 1u, most_threads);
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
