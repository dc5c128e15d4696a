// The threads themselves: oneTBB's, and the only place that names it.
#pragma once

#include <cstddef>
#include <memory>

namespace assay::detector {

class ThreadArena {
 public:
  // Null where the library was built without oneTBB.
  static std::unique_ptr<ThreadArena> make(std::size_t threads);
  virtual ~ThreadArena() = default;
  class Work {
   public:
    virtual ~Work() = default;
    virtual void run(std::size_t i, std::size_t lane) const = 0;
  };
  // work.run(i, lane) for i = 0 .. count - 1, with lane < threads; returns when all have returned,
  // and throws what the first one threw that threw.
  virtual void run(std::size_t count, const Work& work) = 0;
};

}  // namespace assay::detector
