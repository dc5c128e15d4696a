// Arrays that may be large. The system is asked to back them with large pages:
//
//   const std::unique_ptr<float[]> boxes = large_array<float>(6'000'000);
//
// The kernel clears each page at its first touch. With pages of 4 KiB this takes a fifth of the
// time of a mesh of 10^6 triangles that is asked once, and with pages of 2 MiB a tenth. Where a
// system has no large pages, nothing is asked. Small arrays are left alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace assay::detector {

// Only whole large pages inside the array are asked for, so nothing beside it is changed. The
// answer is not looked at: without large pages the array is the same, only slower to make.
inline void ask_for_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t page = 1 << 21;
  const auto first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page,
             last = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / page * page;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

// Returns an array whose values are not set.
template <class Value>
std::unique_ptr<Value[]> large_array(std::size_t count) {
  auto array = std::make_unique_for_overwrite<Value[]>(count);
  ask_for_large_pages(array.get(), count * sizeof(Value));
  return array;
}

template <class Value>
void reserve_large(std::vector<Value>& list, std::size_t count) {
  list.reserve(count);
  ask_for_large_pages(list.data(), count * sizeof(Value));
}

// Sets the size of an empty list. Its values are 0.
template <class Value>
void resize_large(std::vector<Value>& list, std::size_t count) {
  reserve_large(list, count);
  list.resize(count);
}

}  // namespace assay::detector
