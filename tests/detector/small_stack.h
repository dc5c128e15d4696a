// Runs a function in a thread with a small stack, and measures how much stack it used. A detector
// runs in threads that its user made, so no depth of calls may depend on the input.
#pragma once

#include <pthread.h>
#include <sys/mman.h>

#include <cstddef>

#include "tests/test.h"

namespace assay::tests {

inline constexpr std::size_t small_stack_bytes = 128 * 1024;

// Sanitizers make frames several times as large.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::size_t given_stack_bytes = 8 * small_stack_bytes;
#else
inline constexpr std::size_t given_stack_bytes = small_stack_bytes;
#endif

namespace small_stack {

// The thread's own data lies in the same block, above its first frame, and does not count as stack
// of the body. Under the thread sanitizer it is nearly a megabyte.
#if defined(__SANITIZE_THREAD__)
inline constexpr std::size_t threads_own_bytes = 2 * 1024 * 1024;
#else
inline constexpr std::size_t threads_own_bytes = 64 * 1024;
#endif
inline constexpr std::byte untouched{0xa5};
inline constexpr std::size_t page = 4096;

struct Run {
  std::byte* block;
  const std::function<void()>& body;
  std::size_t used = 0;
};

// Counts the stack from this frame downwards. The page below the stack of the body is protected, so
// a body that uses more stack crashes.
inline void* run(void* data) {
  Run& run = *static_cast<Run*>(data);
  std::byte here{};
  const auto from_block = static_cast<std::size_t>(&here - run.block);
  const std::size_t guard = (from_block - given_stack_bytes) / page * page - page;
  if (mprotect(run.block + guard, page, PROT_NONE) != 0) {
    ADD_FAILURE() << "no guard below the stack";
    return nullptr;
  }
  run.body();
  const std::byte* deepest =
      std::find_if(run.block + guard + page, &here, [](std::byte b) { return b != untouched; });
  run.used = static_cast<std::size_t>(&here - deepest);
  return nullptr;
}

}  // namespace small_stack

// Returns how many bytes of stack `body` used, from its caller's frame to the deepest byte that
// `body` wrote.
inline std::size_t on_small_stack(const std::function<void()>& body) {
  constexpr std::size_t bytes = small_stack::threads_own_bytes + given_stack_bytes;
  void* block =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
  if (block == MAP_FAILED) {
    ADD_FAILURE() << "no memory for a stack";
    return 0;
  }
  std::fill_n(static_cast<std::byte*>(block), bytes, small_stack::untouched);
  small_stack::Run run{static_cast<std::byte*>(block), body};
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_t thread{};
  EXPECT_EQ(pthread_attr_setstack(&attributes, block, bytes), 0);
  const int failed = pthread_create(&thread, &attributes, small_stack::run, &run);
  EXPECT_EQ(failed, 0);
  if (failed == 0) pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  munmap(block, bytes);
  return run.used;
}

// Fails if `body` uses more than half of the stack. The other half is left to the caller.
inline void expect_enough_stack(const char* measured, const std::function<void()>& body) {
  const std::size_t used = on_small_stack(body);
  std::printf("%s: %zu KB of stack\n", measured, used / 1024);
  EXPECT_LT(used, given_stack_bytes / 2);
}

}  // namespace assay::tests
