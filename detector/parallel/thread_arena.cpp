#include "detector/parallel/workers.h"

#ifdef ASSAY_HAS_TBB
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#endif

namespace assay::detector {

#ifdef ASSAY_HAS_TBB

namespace {

class TbbArena : public ThreadArena {
 public:
  // oneTBB makes no more threads than there are cores unless it is told to.
  explicit TbbArena(std::size_t threads)
      : allowed_(Control::max_allowed_parallelism,
                 std::max(threads, Control::active_value(Control::max_allowed_parallelism))),
        arena_(static_cast<int>(threads)) {}

  void run(std::size_t count, const Work& work) override {
    arena_.execute([&] {
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        work.run(i, static_cast<std::size_t>(tbb::this_task_arena::current_thread_index()));
      });
    });
  }

 private:
  using Control = tbb::global_control;
  Control allowed_;
  tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<ThreadArena> ThreadArena::make(std::size_t threads) {
  return std::make_unique<TbbArena>(threads);
}

#else

std::unique_ptr<ThreadArena> ThreadArena::make(std::size_t) { return nullptr; }

#endif

}  // namespace assay::detector
