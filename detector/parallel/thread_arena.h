// The threads themselves. They are those of oneTBB, which no other file names.
#pragma once

#include <cstddef>
#include <memory>

namespace assay::detector {

class ThreadArena {
 public:
  // Null if the library was built without oneTBB.
  static std::unique_ptr<ThreadArena> make(std::size_t threads);
  virtual ~ThreadArena() = default;
  class Work {
   public:
    virtual ~Work() = default;
    virtual void run(std::size_t i, std::size_t lane) const = 0;
  };
  // Calls work.run(i, lane) for i = 0 .. count - 1, with lane < threads, and returns when all
  // calls have. No two calls run in one lane at the same time. The calling thread works too, and
  // is one of the threads. If calls throw, the exception of one of them is thrown again, and what
  // had not begun then may be left out.
  virtual void run(std::size_t count, const Work& work) = 0;
};

}  // namespace assay::detector
