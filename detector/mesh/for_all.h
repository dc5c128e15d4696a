// Loops over many items. Several threads (the Workers of a PacedStop) share the work.
//
//   for_all_paced(vertices, work_of_vertex, pace, [&](std::size_t v) { rounded[v] = round(v); });
//
// The bodies run in any order and at the same time, so each may write only to a place of its own.
// If items must be done in their order, use for_each_paced (paced_stop.h). The loop is split into
// pieces, and the calling thread works on pieces too. Only the calling thread counts work and calls
// the stop function; the other threads end within microseconds after it, when their pieces are
// done.
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include "detector/mesh/paced_stop.h"
#include "detector/mesh/topology.h"
#include "detector/parallel/workers.h"

namespace assay::detector {

// A loop of fewer items, about 10 us of work, is not shared: the calling thread does it alone.
inline constexpr std::size_t least_shared = 4096;
// Returns the number of items in a piece of a loop. Pieces are small, so that all threads end at
// about the same time.
inline std::size_t piece_of(std::size_t count) { return count <= least_shared ? count : 1024; }

inline bool has_workers(const PacedStop* pace) {
  return pace && pace->workers() && !pace->workers()->is_alone();
}

// Calls run(begin, end, lane) for pieces of at most `most` items. `run` returns the work that its
// piece took, so the work need not be known before. Returns false if the stop function ended the
// loop. If `pace` is null the loop never ends early, and the calling thread makes all calls.
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

// Does the same if each item counts as work_of_each units of work. Here `run` returns nothing.
template <class Run>
bool for_all_pieces(std::size_t count, std::size_t most, std::uint64_t work_of_each,
                    PacedStop* pace, Run run) {
  return for_all_counted(count, most, pace,
                         [&](std::size_t begin, std::size_t end, std::size_t lane) {
                           run(begin, end, lane);
                           return (end - begin) * work_of_each;
                         });
}

// Calls body(i) for i = 0 .. count - 1; each call counts as work_of_each units of work. Returns
// false if the stop function ended the loop.
template <class Body>
bool for_all_paced(std::size_t count, std::uint64_t work_of_each, PacedStop* pace, Body body) {
  const auto run = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (; begin < end; ++begin) body(begin);
  };
  return for_all_pieces(count, piece_of(count), work_of_each, pace, run);
}
template <class Body>
bool for_all_paced(std::size_t count, std::uint64_t work_of_each, PacedStop& pace, Body body) {
  return for_all_paced(count, work_of_each, &pace, body);
}

// Returns a sum over all items. Each lane starts from `zero` and calls add(sum, i) for its items i;
// join(sum, sum) then adds up the lanes. REQUIRES a sum that does not depend on the order of its
// terms (a sum of doubles depends on it).
template <class Sum, class Add, class Join>
Sum sum_over_all(std::size_t count, std::uint64_t work_of_each, PacedStop* pace, const Sum& zero,
                 Add add, Join join) {
  std::vector<Sum> of_lanes(has_workers(pace) ? pace->workers()->count() : 1, zero);
  for_all_pieces(count, piece_of(count), work_of_each, pace,
                 [&](std::size_t begin, std::size_t end, std::size_t lane) {
                   // Adds to a copy: adding in memory, beside the sums of other lanes, is slow.
                   Sum sum = of_lanes[lane];
                   for (; begin < end; ++begin) add(sum, begin);
                   of_lanes[lane] = sum;
                 });
  Sum sum = of_lanes[0];
  for (std::size_t lane = 1; lane < of_lanes.size(); ++lane) join(sum, of_lanes[lane]);
  return sum;
}

// Lists, for each row, the items of 0 .. items - 1 that are in this row, ascending. rows_of(item)
// gives the rows that an item is in. Each thread fills rows of its own, and looks at all items.
// Returns false if the pace was stopped.
template <class RowsOf>
bool list_by_row(std::size_t items, std::size_t rows, RowsOf rows_of, Incidence& lists,
                 PacedStop& pace) {
  constexpr std::uint64_t work_of_item = 6;
  const bool is_shared = has_workers(&pace);
  const std::size_t lanes = is_shared ? pace.workers()->count() : 1,
                    items_at_once = is_shared ? 32'768 : least_shared;
  const std::size_t of_lane = (rows + lanes - 1) / lanes;
  const auto for_all_in_rows = [&](auto body) {
    for (std::size_t begin = 0; begin < items; begin += items_at_once) {
      const std::size_t end = std::min(begin + items_at_once, items);
      const auto look = [&](std::size_t lane, std::size_t, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
          for (const auto row : rows_of(i)) {
            if (at(row) - lane * of_lane < of_lane) body(static_cast<std::int32_t>(i), at(row));
          }
        }
        return work_of_item * (end - begin);
      };
      if (!for_all_counted(lanes, 1, &pace, look)) return false;
    }
    return true;
  };
  // The items of row r are counted at place r + 2. After summing up, place r + 1 says where the
  // next item of row r goes. When all items are listed, place r + 1 says where row r + 1 begins.
  auto& starts = lists.starts;
  starts.assign(rows + 2, 0);
  if (!for_all_in_rows([&](std::int32_t, std::size_t row) { ++starts[row + 2]; })) return false;
  for (std::size_t row = 2; row < starts.size(); ++row) starts[row] += starts[row - 1];
  lists.items.resize(at(starts.back()));
  starts.pop_back();
  return for_all_in_rows([&](std::int32_t item, std::size_t row) {
    lists.items[static_cast<std::size_t>(starts[row + 1]++)] = item;
  });
}

}  // namespace assay::detector
