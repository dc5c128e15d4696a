// Arrays that may be large. The system is asked to back them with large pages:
//
//   LargeArray<float> boxes(6'000'000);  // the values are not set
//
// The kernel clears each page at its first touch. With pages of 4 KiB that is a fifth of the time
// of a mesh of 10^6 triangles that is asked once; with pages of 2 MiB it is half of that.
// An array of half a page or more begins and ends with a page of its own, so no part of it lies on
// small pages. Where a system has no large pages, nothing is asked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>
#include <vector>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace assay::detector {

inline constexpr std::size_t large_page = 1 << 21;

// Asks for the large pages inside of an array. The answer is not looked at: without large pages the
// array is the same, only slower to make.
inline void ask_for_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  const auto place = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (place + large_page - 1) / large_page * large_page,
                       end = (place + bytes) / large_page * large_page;
  if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#endif
}

// Values without constructors are not set, because large arrays are written as a whole.
template <class Value>
struct LargeAllocator {
  using value_type = Value;

  LargeAllocator() = default;
  template <class Other>
  LargeAllocator(const LargeAllocator<Other>&) {}

  Value* allocate(std::size_t count) {
    if (!is_large(count)) return std::allocator<Value>().allocate(count);
    const std::size_t bytes = (count * sizeof(Value) + large_page - 1) / large_page * large_page;
    void* const begin = ::operator new (bytes, std::align_val_t{large_page});
    ask_for_large_pages(begin, bytes);
    return static_cast<Value*>(begin);
  }
  void deallocate(Value* begin, std::size_t count) {
    if (!is_large(count)) return std::allocator<Value>().deallocate(begin, count);
    ::operator delete (begin, std::align_val_t{large_page});
  }
  template <class Made>
  void construct(Made* place) {
    ::new (static_cast<void*>(place)) Made;
  }
  template <class Made, class... From>
  void construct(Made* place, From&&... from) {
    ::new (static_cast<void*>(place)) Made(std::forward<From>(from)...);
  }
  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }

 private:
  // At least half of the first page has to be used.
  static bool is_large(std::size_t count) { return count >= large_page / 2 / sizeof(Value); }
};

template <class Value>
using LargeArray = std::vector<Value, LargeAllocator<Value>>;

}  // namespace assay::detector
