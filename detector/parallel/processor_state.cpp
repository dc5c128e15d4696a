#include "detector/parallel/processor_state.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace assay::detector {
namespace {

using State = ProcessorState::State;

#if defined(__SSE2__)
// MXCSR as a program starts with it: nothing traps, and all else is 0. The lowest six bits only say
// what arithmetic has met.
constexpr State needed = 0x1F80, met = 0x3F;

State state_now() { return _mm_getcsr(); }
bool is_needed(State state) { return (state & ~met) == needed; }
void put(State state) { _mm_setcsr(state); }
void put_needed() {
  if (!is_needed(state_now())) put(needed);
}
#else
// The environment as a program starts with it. On ARM it holds what becomes of denormals, too.
State state_now() {
  State state;
  std::fegetenv(&state);
  return state;
}
bool is_needed(const State&) { return false; }
void put(const State& state) { std::fesetenv(&state); }
void put_needed() { std::fesetenv(FE_DFL_ENV); }
#endif

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
    struct Turn {
      explicit Turn(const State& callers) {
        if (!is_needed(callers)) put(callers);
      }
      ~Turn() { put_needed(); }
    } const turn(callers_);
    return function();
  };
}

}  // namespace assay::detector
