// Arrays that may be large. The system is asked to back them with large pages:
//
//   LargeArray<float> boxes(6'000'000);  // the values are not set
//
// The kernel clears each page when it is first used. With pages of 4 KiB, clearing takes a fifth of
// the time in which a detector for a mesh of 10^6 triangles is made and answers one step; with
// pages of 2 MiB it takes a tenth. An array of half a large page or more gets whole large pages
// that it shares with no other array, so no part of it lies on small pages. On a system without
// large pages the array is an ordinary one.
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

// Asks the system to use large pages inside this array. Ignores whether the system does so: without
// large pages only the first use of the array is slower.
inline void ask_for_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  const auto place = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (place + large_page - 1) / large_page * large_page,
                       end = (place + bytes) / large_page * large_page;
  if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#endif
}

// Leaves values without constructors unset, because a large array is filled as a whole afterwards.
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
  // An array is large if it fills at least half of a large page.
  static bool is_large(std::size_t count) { return count >= large_page / 2 / sizeof(Value); }
};

template <class Value>
using LargeArray = std::vector<Value, LargeAllocator<Value>>;

}  // namespace assay::detector
