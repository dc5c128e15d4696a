// Loops over many things of one kind, and a sort of them, shared out to the workers of a pace.
//
//   for_all_paced(vertices, work_of_vertex, pace, [&](std::size_t v) { rounded[v] = round(v); });
//
// The bodies run in any order and at the same time, so each may write only to a place of its own.
// If one thing has to follow another, the loop is for_each_paced (paced_stop.h). The calling
// thread takes pieces too. It alone counts work and asks whether to stop, because the pieces of
// the others end within microseconds.
#pragma once

#include <atomic>
#include <bit>
#include <thread>
#include <utility>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/parallel/workers.h"

namespace assay::detector {

// How many items make a piece: some 10 us of work. Fewer are not worth sharing out.
inline constexpr std::size_t shared_piece = 4096;
// The same for rows of positions that are only read or copied.
inline constexpr std::size_t rows_of_piece = 32'768;

inline bool has_workers(const PacedStop* pace) {
  return pace && pace->workers() && !pace->workers()->is_alone();
}

// Calls run(begin, end, lane) for pieces of at most `most` items. `run` returns the work that its
// piece took, so this is for loops whose work is known only when it is done. False if the stop
// function ended the loop. Without a pace it never ends early, and the calling thread does it all.
template <class Run>
bool for_all_counted(std::size_t count, std::size_t most, PacedStop* pace, Run run) {
  if (!has_workers(pace) || count <= most) {
    for (std::size_t begin = 0; begin < count; begin += most) {
      const std::uint64_t work = run(begin, std::min(begin + most, count), std::size_t{0});
      if (pace && pace->after(work)) return false;
    }
    return true;
  }
  std::atomic<bool> is_ended = false;
  const auto caller = std::this_thread::get_id();
  pace->workers()->share_out(count, most, [&](const LoopPiece& piece) {
    if (is_ended.load(std::memory_order_relaxed)) return;
    const std::uint64_t work = run(piece.begin, piece.end, piece.lane);
    if (std::this_thread::get_id() == caller && pace->after(work)) is_ended = true;
  });
  return !pace->stopped();
}

// The same for items each of which costs work_of_each; run returns nothing.
template <class Run>
bool for_all_pieces(std::size_t count, std::size_t most, std::uint64_t work_of_each,
                    PacedStop* pace, Run run) {
  return for_all_counted(count, most, pace,
                         [&](std::size_t begin, std::size_t end, std::size_t lane) {
                           run(begin, end, lane);
                           return (end - begin) * work_of_each;
                         });
}

// Calls body(i) for i = 0 .. count - 1, each of which costs work_of_each. False if it was ended.
template <class Body>
bool for_all_paced(std::size_t count, std::uint64_t work_of_each, PacedStop* pace, Body body) {
  const auto run = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (; begin < end; ++begin) body(begin);
  };
  return for_all_pieces(count, shared_piece, work_of_each, pace, run);
}
template <class Body>
bool for_all_paced(std::size_t count, std::uint64_t work_of_each, PacedStop& pace, Body body) {
  return for_all_paced(count, work_of_each, &pace, body);
}

// Starts from `zero` in each lane, calls add(sum, i) for all i, and puts the sums of the lanes
// together with join(sum, sum). REQUIRES a sum that does not depend on the order; one of doubles
// does.
template <class Sum, class Add, class Join>
Sum sum_over_all(std::size_t count, std::uint64_t work_of_each, PacedStop* pace, const Sum& zero,
                 Add add, Join join) {
  if (!has_workers(pace)) {
    Sum sum = zero;
    for_each_paced(count, work_of_each, pace, [&](std::size_t i) { add(sum, i); });
    return sum;
  }
  std::vector<Sum> of_lanes(pace->workers()->count(), zero);
  for_all_pieces(count, shared_piece, work_of_each, pace,
                 [&](std::size_t begin, std::size_t end, std::size_t lane) {
                   // A copy, because adding in place, beside the sums of other lanes, is slow.
                   Sum sum = of_lanes[lane];
                   for (; begin < end; ++begin) add(sum, begin);
                   of_lanes[lane] = sum;
                 });
  Sum sum = of_lanes[0];
  for (std::size_t lane = 1; lane < of_lanes.size(); ++lane) join(sum, of_lanes[lane]);
  return sum;
}

// A stable sort by a key that is a number, which workers share and a stop function can end.
//
// It sorts by one digit of the key after the other, from the lowest to the highest. For each digit
// it counts, then places, in chunks of the items. A chunk knows from the counts where its items
// go, so the chunks can be worked on in any order, and the result does not depend on the workers.

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
