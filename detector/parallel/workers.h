// The threads of one detector: one thing at a time on the calling thread, or pieces of a loop on
// several threads at once.
//
// What a piece writes belongs to it alone, or to its lane (below), and what lanes have gathered is
// put together so that the order does not show. So a result does not depend on how many threads
// there are, nor on which of them did what. Loops return when all of their pieces are done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "detector/parallel/thread_arena.h"

namespace assay::detector {

// Of a loop: the items begin, ..., end - 1. No two threads work in one lane at once.
struct LoopPiece {
  std::size_t begin, end, lane;
};

class Workers {
 public:
  // 0: as many threads as the machine has. Where the library was built without oneTBB, one does
  // everything.
  explicit Workers(std::uint32_t threads = 1);

  // How many pieces may be worked on at once.
  std::size_t count() const { return count_; }
  bool is_alone() const { return count_ == 1; }

  // Calls the body for pieces that cover [0, count), each of at most `most` items and in a lane
  // below count(), in any order. What a body throws is thrown again here. A body does not call it.
  void share_out(std::size_t count, std::size_t most,
                 const std::function<void(const LoopPiece&)>& body) const;

 private:
  std::size_t count_ = 1;
  std::unique_ptr<ThreadArena> arena_;  // null: alone
};

}  // namespace assay::detector
