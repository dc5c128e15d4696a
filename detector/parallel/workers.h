// The threads of one detector, and the state of the processor in which they compute. The threads
// work on the pieces of a loop at the same time; the calling thread does everything else.
//
// A piece writes only to places of its own, or to places of its lane (LoopPiece). The results of
// the lanes are combined in a way that does not depend on the order of the lanes. So a result
// depends neither on the number of threads nor on which thread worked on which piece. A loop
// returns when all of its pieces are done.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>

#if !defined(__SSE2__)
#include <cfenv>
#endif

namespace assay::detector {

// Runs calls in several threads. The threads are those of oneTBB; only thread_arena.cpp uses this
// library.
class ThreadArena {
 public:
  // Returns null if the library was built without oneTBB.
  static std::unique_ptr<ThreadArena> make(std::size_t threads);
  virtual ~ThreadArena() = default;
  class Work {
   public:
    virtual ~Work() = default;
    virtual void run(std::size_t i, std::size_t lane) const = 0;
  };
  // Calls work.run(i, lane) for i = 0 .. count - 1, with lane < threads, and returns when all calls
  // have returned. No two calls run in one lane at the same time. The calling thread is one of the
  // threads, and makes calls too. If calls throw, throws the exception of one of them; calls that
  // have not begun by then may be left out.
  virtual void run(std::size_t count, const Work& work) = 0;
};

// A piece of a loop: the items begin, ..., end - 1. Lanes are numbered from 0, and no two threads
// work in one lane at the same time, so data kept by lane need no lock.
struct LoopPiece {
  std::size_t begin, end, lane;
};

class Workers {
 public:
  // 0 threads means one for each processor of the machine. In a library built without oneTBB, one
  // thread does everything.
  explicit Workers(std::uint32_t threads = 1);
  // Uses this arena, which has `lanes` lanes; it can be an arena that measures, for example.
  // REQUIRES that `arena` is not null, and lanes >= 2.
  Workers(std::unique_ptr<ThreadArena> arena, std::size_t lanes);

  // Returns how many pieces may be worked on at once, which is also the number of lanes.
  std::size_t count() const { return count_; }
  bool is_alone() const { return count_ == 1; }

  // Calls the body for pieces that cover [0, count), each of at most `most` items, in any order
  // and in lanes below count(). An exception that a body throws is thrown again here. REQUIRES that
  // no body calls share_out.
  void share_out(std::size_t count, std::size_t most,
                 const std::function<void(const LoopPiece&)>& body) const;

 private:
  std::size_t count_ = 1;
  std::unique_ptr<ThreadArena> arena_;  // null if the calling thread works alone
};

// Makes a user's stop function usable in several threads. Only the thread that makes this object
// calls the user's function, so that function need not be thread-safe. All threads learn what it
// has returned.
class SharedStop {
 public:
  // `stop` must outlive this object, and this object must outlive what function() returns.
  explicit SharedStop(const std::function<bool()>& stop)
      : stop_(stop), caller_(std::this_thread::get_id()) {}

  // Returns a stop function for all threads. It returns true as soon as the user's function has
  // returned true, and it is empty if the user's function is empty.
  std::function<bool()> function() {
    if (!stop_) return {};
    return [this] {
      if (is_stopped_.load(std::memory_order_relaxed)) return true;
      if (std::this_thread::get_id() != caller_ || !stop_()) return false;
      is_stopped_.store(true, std::memory_order_relaxed);
      return true;
    };
  }

 private:
  const std::function<bool()>& stop_;
  const std::thread::id caller_;
  std::atomic<bool> is_stopped_ = false;
};

// Sets the state of the processor that every bound and sign of the detector depends on: doubles
// round to nearest, no denormal number is flushed or read as zero, and nothing traps.
//
// A library that was built for speed changes this state in the thread that loads the library, and
// in all threads that this thread starts. So each function of the detector that computes makes a
// ProcessorState first, and each piece of a loop in another thread does so too.
class ProcessorState {
 public:
#if defined(__SSE2__)
  using State = unsigned;  // MXCSR; double arithmetic does not use the x87
#else
  using State = std::fenv_t;
#endif
  // Takes a few ns if the state is set already.
  ProcessorState();
  // Puts back the state that the caller had.
  ~ProcessorState();
  ProcessorState(const ProcessorState&) = delete;
  ProcessorState& operator=(const ProcessorState&) = delete;

  // Returns a function that calls `function` in the state of the caller, and then sets this state
  // again, even if `function` has changed it. The result is empty if `function` is empty. This
  // object and `function` must outlive the result.
  std::function<bool()> in_callers_state(const std::function<bool()>& function) const;

 private:
  const State callers_;
};

}  // namespace assay::detector
