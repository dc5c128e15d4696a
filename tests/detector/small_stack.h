// Runs what a test calls in a thread whose stack is small, and says how much of it was used: a
// detector is called from threads that its user made, and no depth of calls may depend on numbers.
#pragma once

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>

namespace assay::tests {

inline constexpr std::size_t small_stack_bytes = 128 * 1024;

// Sanitizers make frames several times as large.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::size_t given_stack_bytes = 8 * small_stack_bytes;
#else
inline constexpr std::size_t given_stack_bytes = small_stack_bytes;
#endif

// Bytes that were used, those of the thread itself included (about 4 KB). A page below the stack
// cannot be written: what uses more crashes.
inline std::size_t on_small_stack(std::function<void()> body) {
  constexpr std::size_t guard = 4096;
  constexpr std::byte untouched{0xa5};
  void* block = mmap(nullptr, guard + given_stack_bytes, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
  if (block == MAP_FAILED || mprotect(block, guard, PROT_NONE) != 0) {
    ADD_FAILURE() << "no memory for a stack";
    return 0;
  }
  auto* stack = static_cast<std::byte*>(block) + guard;
  std::fill_n(stack, given_stack_bytes, untouched);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_t thread{};
  const auto call = [](void* given) -> void* {
    (*static_cast<std::function<void()>*>(given))();
    return nullptr;
  };
  EXPECT_EQ(pthread_attr_setstack(&attributes, stack, given_stack_bytes), 0);
  const int failed = pthread_create(&thread, &attributes, call, &body);
  EXPECT_EQ(failed, 0);
  if (failed == 0) pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  const auto* deepest =
      std::find_if(stack, stack + given_stack_bytes, [](std::byte b) { return b != untouched; });
  const auto used = static_cast<std::size_t>(stack + given_stack_bytes - deepest);
  munmap(block, guard + given_stack_bytes);
  return used;
}

}  // namespace assay::tests
