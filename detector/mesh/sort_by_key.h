// A stable sort by a key that is a number, which workers share and a stop function can end.
//
// It sorts by one digit of the key after the other, from the lowest to the highest. For each digit
// it counts, then places, in chunks of the items. A chunk knows from the counts where its items
// go, so the chunks can be worked on in any order, and the result does not depend on the workers.
#pragma once

#include <bit>
#include <utility>

#include "detector/mesh/for_all.h"

namespace assay::detector {

namespace sorting {

// How the items are cut up.
struct Chunks {
  unsigned digit_bits;
  std::size_t of_chunk, sets_of_counts;  // one thread needs one set, for all chunks

  // A key of few bits is one digit: there are then as few chunks as there are threads, because each
  // has many counts. Else the counts of a chunk fit into the fastest cache.
  Chunks(std::size_t items, unsigned bits, const PacedStop* pace) {
    constexpr unsigned few_bits = 16, most_bits = 11;
    constexpr std::size_t usual = 8192;
    const unsigned digits = bits <= few_bits ? 1 : (bits + most_bits - 1) / most_bits;
    digit_bits = (bits + digits - 1) / digits;
    of_chunk = usual;
    sets_of_counts = 1;
    if (!has_workers(pace)) return;
    if (digits == 1) {
      const std::size_t chunks =
          std::clamp<std::size_t>(items >> bits, 1, pace->workers()->count());
      of_chunk = std::max(usual, (items + chunks - 1) / chunks);
    }
    sets_of_counts = (items + of_chunk - 1) / of_chunk;
  }
};

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
  const auto bits = static_cast<unsigned>(std::bit_width(greatest | 1));
  const sorting::Chunks cut(items.size(), bits, pace);
  const auto width = cut.digit_bits;
  const auto of_chunk = cut.of_chunk, sets = cut.sets_of_counts;
  const std::size_t digits = std::size_t{1} << width,
                    chunks = (items.size() + of_chunk - 1) / of_chunk;
  std::vector<std::uint32_t> places(sets * digits);
  room.resize(items.size());
  const auto by_chunk = [&](std::uint64_t work_of_each, auto body) {
    return for_all_counted(chunks, 1, pace, [&](std::size_t c, std::size_t, std::size_t) {
      const std::size_t begin = c * of_chunk, end = std::min(begin + of_chunk, items.size());
      // One thread takes the chunks in their order, so that they can share their counts.
      body(places.data() + (sets == 1 ? 0 : c * digits), begin, end);
      return work_of_each * (end - begin);
    });
  };
  for (unsigned shift = 0; shift < bits; shift += width) {
    const auto digit = [&key, shift, digits](const Item& item) {
      return static_cast<std::uint64_t>(key(item)) >> shift & (digits - 1);
    };
    const auto count = [&](std::uint32_t* counts, std::size_t begin, std::size_t end) {
      const Item* const from = items.data();
      for (; begin < end; ++begin) ++counts[digit(from[begin])];
    };
    const auto place = [&](std::uint32_t* next, std::size_t begin, std::size_t end) {
      const Item* const from = items.data();
      Item* const to = room.data();
      for (; begin < end; ++begin) to[next[digit(from[begin])]++] = from[begin];
    };
    std::fill(places.begin(), places.end(), 0);
    if (!by_chunk(work_to_count, count)) return false;
    if (!sorting::to_places(places, digits, items.size())) continue;
    if (!by_chunk(work_to_place, place)) return false;
    std::swap(items, room);
  }
  return true;
}

}  // namespace assay::detector
