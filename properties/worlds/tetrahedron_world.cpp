#include "properties/worlds/tetrahedron_world.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "properties/worlds/tetrahedron_check.h"

namespace assay::properties {
namespace {

using Clock = std::chrono::steady_clock;

constexpr TetrahedronWorld worlds[] = {
    {"square-2", "{0,2}^2, all in a plane, every vertex moves", {2, 2, 4}},
    {"cube-2-one", "{0,2}^3, at most one vertex moves", {2, 3, 1}},
    {"cube-2-two", "{0,2}^3, at most two vertices move", {2, 3, 2}},
    {"cube-2", "{0,2}^3, every vertex moves", {2, 3, 4}},
    {"cube-3-one", "{0,2,4}^3, at most one vertex moves", {3, 3, 1}},
    {"cube-3-two", "{0,2,4}^3, at most two vertices move", {3, 3, 2}},
};

// The state that the threads of one world share.
class Run {
 public:
  Run(const TetrahedronWorld& world, const TetrahedronWorldOptions& options)
      : world_(world), options_(options), motions_(world.grid), begin_(Clock::now()) {}

  void work() {
    TetrahedronWorldResult own;
    for (;;) {
      const std::size_t block = next_.fetch_add(1);
      if (block >= motions_.blocks() || stopped_ || block > failed_block_) break;
      bool through = true;
      motions_.for_each(block, [&](const TetrahedronMotion& motion) {
        through = !must_stop() && check(block, motion, own);
        return through;
      });
      if (!through) break;
    }
    merge(own);
  }

  TetrahedronWorldResult result() {
    result_.all = motions_.all();
    result_.complete = !stopped_ && !result_.counterexample;
    result_.seconds = seconds();
    if (result_.counterexample) result_.counterexample->id = "tetrahedron-" + name();
    return std::move(result_);
  }

 private:
  std::string name() const { return world_.name; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  bool must_stop() {
    if ((options_.seconds > 0 && seconds() > options_.seconds) ||
        (options_.stop && options_.stop())) {
      stopped_ = true;
    }
    return stopped_;
  }

  bool check(std::size_t block, const TetrahedronMotion& motion, TetrahedronWorldResult& own) {
    auto failure = check_tetrahedron(motion, own);
    if (!failure) return true;
    const std::lock_guard lock(mutex_);
    if (block < failed_block_) {
      failed_block_ = block;
      result_.counterexample = std::move(failure->c);
      result_.explanation = std::move(failure->explanation);
    }
    return false;
  }

  void merge(const TetrahedronWorldResult& own) {
    const std::lock_guard lock(mutex_);
    result_.classes += own.classes;
    result_.motions += own.motions;
    result_.collisions += own.collisions;
    result_.clean_starts += own.clean_starts;
    result_.first_in_k += own.first_in_k;
    result_.one_sign += own.one_sign;
    result_.all_positive += own.all_positive;
  }

  const TetrahedronWorld& world_;
  const TetrahedronWorldOptions& options_;
  const TetrahedronMotions motions_;
  const Clock::time_point begin_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<std::size_t> failed_block_ = std::numeric_limits<std::size_t>::max();
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  TetrahedronWorldResult result_;
};

}  // namespace

std::span<const TetrahedronWorld> tetrahedron_worlds() { return worlds; }

TetrahedronWorldResult prove(const TetrahedronWorld& world,
                             const TetrahedronWorldOptions& options) {
  Run run(world, options);
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < options.jobs; ++i) others.emplace_back([&run] { run.work(); });
    run.work();
  }
  return run.result();
}

}  // namespace assay::properties
