// The state of the processor that every bound and sign of this room rests on: doubles round to
// nearest, no denormal number is flushed or read as zero, and nothing traps.
//
// A library that was built for speed changes this state for the thread that loads it and for all
// threads that this one starts. So each call of the detector that computes begins with one of
// these objects, and so does each piece of work in another thread.
#pragma once

#include <functional>

#if !defined(__SSE2__)
#include <cfenv>
#endif

namespace assay::detector {

class ProcessorState {
 public:
#if defined(__SSE2__)
  using State = unsigned;  // MXCSR; double arithmetic does not use the x87
#else
  using State = std::fenv_t;
#endif
  // Takes a few ns where the state is right already.
  ProcessorState();
  // Puts back the state that the caller had.
  ~ProcessorState();
  ProcessorState(const ProcessorState&) = delete;
  ProcessorState& operator=(const ProcessorState&) = delete;

  // A function that calls `function` in the state of the caller; empty if `function` is. Both this
  // object and `function` must outlive it. Whatever `function` does to the state is undone.
  std::function<bool()> in_callers_state(const std::function<bool()>& function) const;

 private:
  const State callers_;
};

}  // namespace assay::detector
