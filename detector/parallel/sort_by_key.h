// A stable sort by a key that is a number, which workers share and a stop function can end.
//
// It sorts by one digit of the key after the other, from the lowest to the highest. For each digit
// it counts, then places, in chunks of the items. A chunk knows from the counts where its items
// go, so the chunks can be worked on in any order, and the result does not depend on the workers.
#pragma once

#include <bit>

#include "detector/parallel/for_all.h"

namespace assay::detector {

namespace sorting {

inline constexpr std::size_t chunk = 8192;

// The bits of a digit. The counts of a chunk should fit into the fastest cache. One thread needs
// one set of counts for all chunks, which may be larger.
inline unsigned digit_bits(unsigned bits, bool is_alone) {
  const unsigned most = is_alone && bits <= 16 ? 16 : 11, digits = (bits + most - 1) / most;
  return (bits + digits - 1) / digits;
}

// Turns how often each digit occurs in each chunk into the place of its first item there. False
// if all items have one digit, so that nothing has to be moved.
inline bool to_places(std::vector<std::uint32_t>& counts, std::size_t digits, std::size_t items) {
  std::vector<std::uint32_t> next(digits, 0);
  for (std::size_t i = 0; i < counts.size(); i += digits) {
    for (std::size_t d = 0; d < digits; ++d) next[d] += counts[i + d];
  }
  std::uint32_t sum = 0;
  for (auto& of_digit : next) {
    if (of_digit == items) return false;
    sum += std::exchange(of_digit, sum);
  }
  for (std::size_t i = 0; i < counts.size(); i += digits) {
    for (std::size_t d = 0; d < digits; ++d) next[d] += std::exchange(counts[i + d], next[d]);
  }
  return true;
}

}  // namespace sorting

// Sorts `items`; items with equal keys stay in their order. REQUIRES fewer than 2^32 items, and a
// key from 0 to `greatest` of each. `room` is working memory, which can be handed to the next
// sort. False if the pace was stopped: then the items are of no use.
template <class Item, class Key>
bool sort_by_key(std::vector<Item>& items, std::vector<Item>& room, std::uint64_t greatest, Key key,
                 PacedStop* pace) {
  constexpr std::size_t small = 256;
  constexpr std::uint64_t work_to_count = 1, work_to_place = 2, work_if_small = 16;
  if (items.size() < small) {
    std::stable_sort(items.begin(), items.end(),
                     [&](const Item& a, const Item& b) { return key(a) < key(b); });
    return !(pace && pace->after(work_if_small * items.size()));
  }
  const bool is_alone = !has_workers(pace);
  const auto bits = static_cast<unsigned>(std::bit_width(greatest | 1)),
             width = sorting::digit_bits(bits, is_alone);
  const std::size_t digits = std::size_t{1} << width,
                    chunks = (items.size() + sorting::chunk - 1) / sorting::chunk;
  // One thread takes the chunks in their order, so that they can share their counts.
  std::vector<std::uint32_t> places((is_alone ? 1 : chunks) * digits);
  room.resize(items.size());
  const auto by_chunk = [&](std::uint64_t work_of_each, auto body) {
    return for_all_counted(chunks, 1, pace, [&](std::size_t c, std::size_t, std::size_t) {
      const std::size_t begin = c * sorting::chunk,
                        end = std::min(begin + sorting::chunk, items.size());
      body(places.data() + (is_alone ? 0 : c * digits), begin, end);
      return work_of_each * (end - begin);
    });
  };
  for (unsigned shift = 0; shift < bits; shift += width) {
    const auto digit = [&, shift](const Item& item) {
      return static_cast<std::uint64_t>(key(item)) >> shift & (digits - 1);
    };
    const auto count = [&](std::uint32_t* counts, std::size_t begin, std::size_t end) {
      for (; begin < end; ++begin) ++counts[digit(items[begin])];
    };
    const auto place = [&](std::uint32_t* next, std::size_t begin, std::size_t end) {
      for (; begin < end; ++begin) room[next[digit(items[begin])]++] = items[begin];
    };
    std::fill(places.begin(), places.end(), 0);
    if (!by_chunk(work_to_count, count)) return false;
    if (!sorting::to_places(places, digits, items.size())) continue;
    if (!by_chunk(work_to_place, place)) return false;
    std::swap(items, room);
  }
  return true;
}
template <class Item, class Key>
bool sort_by_key(std::vector<Item>& items, std::vector<Item>& room, std::uint64_t greatest, Key key,
                 PacedStop& pace) {
  return sort_by_key(items, room, greatest, key, &pace);
}

}  // namespace assay::detector
